#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>

#include "config/declare/write.hpp"
#include "material/library.hpp"
#include "material/model_keys.hpp"

namespace recoil {

namespace {

using namespace model_keys;

template <class Model>
std::string lines_of(const Model& model, const std::string& below = {}) {
  std::string text;
  // A file is kept beside what is written.
  if constexpr (requires { model.path; })
    text += below + "file = " + config::written_text(std::filesystem::path(model.file).filename().string()) +
            "\n";
  for (const auto& p : Model::parameters()) {
    const double value = model.*p.member;
    if (!std::isnan(value)) text += below + p.name + " = " + written(p, value) + "\n";
  }
  return text;
}

/// @param below of a table within the table: "solid."; else empty.
template <class Variant>
std::string model_lines(const Variant& variant, const std::string& below = {}) {
  return std::visit(
      [&]<class Model>(const Model& model) {
        std::string text = below + "kind = \"" + model.kind + "\"\n" + lines_of(model, below);
        if constexpr (requires { model.solid; }) text += model_lines(model.solid, "solid.");
        return text;
      },
      variant);
}

/// What is not of the strength model.
Melting own_melting(const Material& m) {
  Melting melting = m.melting;
  if (!std::isnan(melting_temperature(m.strength, 1))) melting.temperature = unset;
  if (std::holds_alternative<SteinbergGuinan>(m.strength)) melting.slope = melting.gamma0 = unset;
  return melting;
}

}  // namespace

std::string to_toml(const Material& m, const std::string& table) {
  const std::string prefix = table.empty() ? "" : table + ".";
  std::string text = table.empty() ? "" : "[" + table + "]\n";
  text += "title = " + config::written_text(m.title) + "\ncite = [";
  for (std::size_t i = 0; i < m.cite.size(); ++i)
    text += (i > 0 ? ", " : "") + config::written_text(m.cite[i]);
  text += "]\n";
  if (!m.doubt.empty()) text += "doubt = " + config::written_text(m.doubt) + "\n";
  text += "\n[" + prefix + "eos]\n" + model_lines(m.eos);
  text += "\n[" + prefix + "strength]\n" + model_lines(m.strength);
  if (can_fail(m.damage)) {
    text += "\n[" + prefix + "damage]\n" + model_lines(m.damage);
    if (m.damage_average.averages()) text += lines_of(m.damage_average);
    text += "\n[" + prefix + "failed]\n" + lines_of(m.failed);
  }
  const bool by_energy = m.thermal.rule == Thermal::Rule::energy;
  text += "\n[" + prefix + "thermal]\ntemperature = " + (by_energy ? "\"energy\"\n" : "\"plastic-work\"\n");
  Thermal thermal = m.thermal;
  if (tabular(m.eos)) thermal.specific_heat = unset;
  text += lines_of(thermal);
  if (m.melting.melts()) text += "\n[" + prefix + "melting]\n" + lines_of(own_melting(m));
  const std::string facts = lines_of(m.facts);
  if (!facts.empty()) text += "\n[" + prefix + "facts]\n" + facts;
  return text;
}

}  // namespace recoil
