#include "material/melting_keys.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "material/model_keys.hpp"

namespace recoil {

using config::Diagnostics;
using namespace model_keys;

namespace {

/// Whether the strength model of a kind has a melting temperature.
bool knows_melting(const std::string& kind) {
  bool knows = false;
  for_each_model<Strength>([&](const auto& model) {
    if (kind == model.kind) knows = requires {
        model.melting_temperature;
      };
  });
  return knows;
}

}  // namespace

Melting read_melting(const Node& table, const Material& material, Diagnostics& out) {
  const std::vector<Key> keys = keys_of_model<Melting>(false);
  const Record record = read_record(table, keys, out);
  Melting melting;
  take(melting, record);
  const double own = melting_temperature(material.strength, 1);
  const auto* curve = std::get_if<SteinbergGuinan>(&material.strength);
  const auto refuse = [&](const char* key, const char* why, const char* help) {
    if (record.has(key)) out.error(record.key_place(key), why, help);
  };
  if (!std::isnan(own)) {
    refuse("temperature", "the strength model has the melting temperature", "leave it out here");
    melting.temperature = own;
  } else if (!record.has("temperature")) {
    out.error(table.key_place, "[melting] needs a temperature",
              "temperature = \"933 K\", the melting temperature without pressure");
  }
  if (curve) {
    refuse("slope", "the strength model has the melting curve", "leave it out here");
    refuse("gamma0", "the strength model has the melting curve", "leave it out here");
    melting.slope = curve->melting_slope, melting.gamma0 = curve->gamma0, melting.at_rest = true;
  } else if (std::isnan(melting.slope) != std::isnan(melting.gamma0)) {
    out.error(table.key_place, "slope and gamma0 of a melting curve belong together",
              "give both, or neither: then the curve follows from the equation of state");
  }
  if (tabular(material.eos))
    refuse("heat", "the table of the equation of state has the latent heat, if there is any",
           "leave heat out");
  if (is_fluid(material.eos)) out.error(table.key_place, "a gas does not melt", "leave [melting] out");
  if (melting.temperature <= material.thermal.initial_temperature)
    out.error(record.has("temperature") ? record.place("temperature") : table.key_place,
              "the material is molten at the start: its melting temperature is not above its "
              "initial-temperature",
              "a lower thermal.initial-temperature, or no [melting]");
  return melting;
}

void keep_melting(Node& base, const Node& over) {
  const std::string kind = kind_of(over, "strength"), before = kind_of(base, "strength");
  Node* melting = base.find("melting");
  if (!melting || kind.empty() || kind == before) return;
  if (knows_melting(kind)) {
    const bool curve = kind == SteinbergGuinan::kind;
    *melting = reduced(std::move(*melting), [&](const std::string& key) {
      return key != "temperature" && !(curve && (key == "slope" || key == "gamma0"));
    });
  } else if (knows_melting(before)) {
    const Node* own = over.find("melting");
    if (!own || !own->find("temperature"))
      base = reduced(std::move(base), [](const std::string& key) { return key != "melting"; });
  }
}

}  // namespace recoil
