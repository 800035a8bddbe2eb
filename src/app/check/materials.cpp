#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <variant>

#include "app/check/checks.hpp"
#include "core/error.hpp"
#include "material/lint.hpp"
#include "material/starting_state.hpp"

namespace recoil::app {

namespace {

using config::Node;

// Cells on each side that damage is averaged over: with fewer, those beside a cell weigh a third or less.
constexpr double least_averaged = 1.5;

/// The value of a constant of a material as it stands in the case, also where a material of the case is the
/// base of another; null: it comes from the library.
const Node* written_constant(const LoadedCase& loaded, std::string name, const std::string& key) {
  const Node* all = loaded.document.find("material");
  for (std::size_t n = 0; all && n <= all->children.size(); ++n) {  // bases may go in a circle
    const Node* table = all->find(name);
    if (!table) return nullptr;
    const Node* node = table;
    for (const std::string& part : config::split_path(key)) node = node ? node->find(part) : nullptr;
    if (node) return node;
    const Node* base = table->find("base");
    if (!base || !base->is_text()) return nullptr;
    name = base->text;
  }
  return nullptr;
}

/// A material of the case that no body uses, nor another one as its base, is a slip of the pen.
void check_unused(LoadedCase& loaded) {
  const Node* all = loaded.document.find("material");
  if (all == nullptr || !all->is_table()) return;
  for (const Node& own : all->children) {
    const auto& bodies = loaded.contents.bodies;
    const bool used = std::ranges::any_of(bodies, [&](const auto& b) { return b.material == own.key; }) ||
                      std::ranges::any_of(all->children, [&](const Node& other) {
                        const Node* base = other.is_table() ? other.find("base") : nullptr;
                        return base != nullptr && base->is_text() && base->text == own.key;
                      });
    if (!used)
      loaded.found.warning(
          own.key_place, fmt::format("no body is of the material '{}'", own.key),
          fmt::format("write material = \"{}\" in a body, or take [material.{}] out", own.key, own.key));
  }
}

/// A pressure or temperature at the start that the material cannot have.
void check_starting_states(LoadedCase& loaded) {
  for (std::size_t m = 0; m < loaded.materials.size(); ++m) {
    const config::Body& body = loaded.contents.bodies[m];
    if (body.rigid || body.takes_up_fragments() || !(body.pressure || body.temperature)) continue;
    try {
      state_at_start(loaded.materials[m], body.pressure, body.temperature, body.name);
    } catch (const InputError& e) {
      const std::string key = "body." + body.name + (body.pressure ? ".pressure" : ".temperature");
      loaded.found.error(place_of(loaded, key, body.place), e.what(),
                         "change its pressure or temperature, or its material");
    }
  }
}

/// Only the conservative scheme with three stages knows a shear modulus that follows the state.
void check_modulus(LoadedCase& loaded, const std::string& material, const Material& m,
                   const config::Place& place) {
  const config::Method& method = loaded.contents.method;
  if (!modulus_follows(m.strength)) return;
  if (method.scheme != "conservative" || method.stages != "three")
    loaded.found.error(
        place,
        fmt::format(
            "material '{}': only the conservative scheme with three stages knows a shear modulus that "
            "follows the state",
            material),
        "modulus-follows = 0, or scheme = \"conservative\" with stages = \"three\"");
}

/// A mean of damage reaches over so many cells that they see each other, and over more than one.
void check_damage_average(LoadedCase& loaded, const std::string& material, const DamageAverage& average,
                          const config::Place& place) {
  if (!average.averages()) return;
  const double cells = average.length / loaded.contents.mesh.finest;
  if (cells > DamageAverage::most_cells)
    loaded.found.error(
        place,
        fmt::format(
            "material '{}': damage is averaged over {:.3g} cells on each side, at most {} are possible",
            material, cells, DamageAverage::most_cells),
        fmt::format("length = \"{:.4g} mm\" or less, or a coarser mesh.finest",
                    DamageAverage::most_cells * loaded.contents.mesh.finest * 1e3));
  else if (cells < least_averaged)
    loaded.found.warning(
        place,
        fmt::format("material '{}': damage is averaged over {:.3g} cells on each side, which hardly averages",
                    material, cells),
        fmt::format("a mesh.finest of {:.4g} mm or less", average.length / least_averaged * 1e3));
}

}  // namespace

void check_materials(LoadedCase& loaded) {
  check_unused(loaded);
  check_starting_states(loaded);
  std::set<std::string> seen;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m) {
    const config::Body& body = loaded.contents.bodies[m];
    if (body.rigid || !seen.insert(body.material).second) continue;
    const auto place = [&](const std::string& key) {
      const Node* node = written_constant(loaded, body.material, key);
      return node ? node->place : body.material_place;
    };
    const Damage& damage = loaded.materials[m].damage;
    check_modulus(loaded, body.material, loaded.materials[m], place("strength.modulus-follows"));
    check_damage_average(loaded, body.material, loaded.materials[m].damage_average, place("damage.length"));
    if (can_fail(damage) && loaded.contents.method.scheme != "conservative")
      loaded.found.error(
          body.material_place,
          fmt::format("material '{}' has damage, which only the conservative scheme knows", body.material),
          "take [material.*.damage] away, or choose scheme = \"conservative\"");
    if (std::holds_alternative<MinimumPressure>(damage))
      loaded.found.warning(
          place("damage.kind"),
          fmt::format("material '{}' fails at once at a tension: what fails depends on the mesh",
                      body.material),
          "kind = \"tensile\" has a time to failure, and converges");
    for (const Suspicion& s : lint(loaded.materials[m])) {
      const std::string message = fmt::format("material '{}': {}", body.material, s.message);
      if (s.certain)
        loaded.found.error(place(s.key), message, s.help);
      else
        loaded.found.warning(place(s.key), message, s.help);
    }
    if (!loaded.materials[m].doubt.empty())
      loaded.found.warning(place("doubt"), fmt::format("material '{}' is in doubt", body.material),
                           loaded.materials[m].doubt);
  }
}

}  // namespace recoil::app
