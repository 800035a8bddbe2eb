#include "app/report/material_data.hpp"

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "app/bibliography.hpp"

namespace recoil::app {

namespace {

/// A model's constants; those without a value are left out.
template <class Model>
Json table_of(const char* name, const char* kind, const Model& model) {
  Json j = {{"name", name}, {"kind", kind}, {"constants", Json::array()}};
  if constexpr (requires { Model::texts(); })
    for (const auto& t : Model::texts())
      j["constants"].push_back({{"name", t.name}, {"value", model.*t.member}, {"unit", ""}, {"doc", t.doc}});
  for (const auto& p : Model::parameters()) {
    const double value = model.*p.member;
    if (std::isnan(value)) continue;
    j["constants"].push_back({{"name", p.name},
                              {"value", std::isinf(value) ? Json("no limit") : Json(value)},
                              {"unit", std::string(p.unit) == "1" ? "" : p.unit},
                              {"doc", p.doc}});
  }
  return j;
}

template <class Variant>
Json table_of_kind(const char* name, const Variant& variant) {
  return std::visit([name](const auto& model) { return table_of(name, model.kind, model); }, variant);
}

Json material_json(const Material& m) {
  const bool by_energy = m.thermal.rule == Thermal::Rule::energy;
  Json j = {{"name", m.name}, {"title", m.title}, {"doubt", m.doubt}, {"cite", m.cite}};
  j["tables"] = {table_of_kind("equation of state", m.eos), table_of_kind("strength", m.strength),
                 table_of("temperature", by_energy ? "by energy" : "by plastic work", m.thermal),
                 table_of("facts", "for checks", m.facts)};
  const char* curve = m.melting.has_own_curve() ? "a curve of its own" : "by the equation of state";
  if (m.melting.melts()) j["tables"].insert(j["tables"].begin() + 3, table_of("melting", curve, m.melting));
  if (const auto* porous = std::get_if<Porous>(&m.eos))
    j["tables"].insert(j["tables"].begin() + 1, table_of_kind("its solid", porous->solid));
  return j;
}

}  // namespace

Json materials_json(const LoadedCase& loaded) {
  Json all = Json::array();
  std::set<std::string> seen;
  const auto& bodies = loaded.contents.bodies;
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    if (bodies[m].rigid || !seen.insert(bodies[m].material).second) continue;
    Json j = material_json(loaded.materials[m]);
    for (const config::Body& body : bodies)
      if (!body.rigid && body.material == bodies[m].material) j["bodies"].push_back(body.name);
    all.push_back(std::move(j));
  }
  return all;
}

Json sources_json(const LoadedCase& loaded) {
  Json all = Json::array();
  for (const Source& s : sources_of(loaded))
    all.push_back({{"key", s.key}, {"text", s.text}, {"bibtex", s.bibtex}});
  return all;
}

}  // namespace recoil::app
