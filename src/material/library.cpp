#include "material/library.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "config/table.hpp"
#include "material/melting_keys.hpp"
#include "material/model_keys.hpp"
#include "material/unknown_material.hpp"

namespace recoil {

namespace {

using config::Diagnostics;
using config::Key;
using config::Node;
using config::Place;
using config::Record;
using namespace model_keys;

constexpr const char* eos_doc = "which equation of state";
constexpr const char* solid_doc = "equation of state of the solid of porous matter";
constexpr const char* strength_doc = "which strength model";
constexpr const char* damage_doc = "which damage model: how matter comes to fail";
constexpr const char* failed_doc = "what failed matter still bears";
constexpr const char* melting_doc =
    "melting temperature and latent heat; without it only strength models that know a melting temperature "
    "melt";

std::vector<Key> top_keys(bool in_case) {
  std::vector<Key> keys{
      {.name = "title", .type = Key::Type::text, .doc = "one line for people"},
      {.name = "cite", .type = Key::Type::texts, .doc = "sources of the numbers"},
      {.name = "doubt",
       .type = Key::Type::text,
       .doc = "what may be wrong with the numbers; `check` and `material show` say it"},
      {.name = "eos",
       .type = Key::Type::table,
       .required = true,
       .doc = "equation of state: a table with its kind"},
      {.name = "strength",
       .type = Key::Type::table,
       .required = true,
       .doc = "strength: a table with its kind, at least { kind = \"none\" }"},
      {.name = "damage",
       .type = Key::Type::table,
       .doc = "how it fails: a table with its kind; without it matter never fails"},
      {.name = "failed", .type = Key::Type::table, .doc = failed_doc},
      {.name = "thermal",
       .type = Key::Type::table,
       .required = true,
       .doc = "heat and temperature: a table with at least the specific-heat"},
      {.name = "melting", .type = Key::Type::table, .doc = melting_doc},
      {.name = "facts", .type = Key::Type::table, .doc = "for checks of plausibility only"}};
  if (in_case) {
    const char* doc = "a material of the library or of this case that this one changes";
    keys.insert(keys.begin(),
                {.name = "base", .type = Key::Type::text, .doc = doc, .example = "copper/seed"});
    for (Key& key : keys) key.required = false;
  }
  return keys;
}

std::vector<Key> thermal_keys() {
  std::vector<Key> keys = keys_of_model<Thermal>();
  keys.insert(keys.begin(),
              {.name = "temperature",
               .type = Key::Type::choice,
               .default_text = "energy",
               .doc = "from the internal energy, so that shocks heat, or from plastic work alone",
               .choices = {"energy", "plastic-work"}});
  return keys;
}

/// Keys that a table has beside those of the model of its kind.
template <class Variant>
std::vector<Key> common_keys() {
  if constexpr (std::is_same_v<Variant, Damage>) return keys_of_model<DamageAverage>(false);
  return {};
}

/// Reads [eos], [strength] or [damage]: `kind` first, then the keys of that model.
template <class Variant>
void read_model(const Node& table, const char* doc, Variant& into, Diagnostics& out) {
  const std::vector<Key> only{kind_key<Variant>(doc)};
  const Node kind_part = reduced(table, [](const std::string& key) { return key == "kind"; });
  const std::string kind = [&] {
    const Record record = read_record(kind_part, only, out);
    return record.good("kind") ? record.text("kind") : std::string();
  }();
  const std::vector<Key> common = common_keys<Variant>();
  const auto is_common = [&](const std::string& key) {
    return std::any_of(common.begin(), common.end(), [&](const Key& k) { return key == k.name; });
  };
  const Node rest = reduced(table, [&](const std::string& key) { return key != "kind" && !is_common(key); });
  for_each_model<Variant>([&](auto model) {
    if (kind != model.kind) return;
    const std::vector<Key> keys = keys_of_model<decltype(model)>();
    const Record record = read_record(rest, keys, out);
    take(model, record);
    if constexpr (requires { model.path; })  // of a file: seen from the folder of the one that names it
      if (record.good("file"))
        model.path = std::filesystem::path(record.place("file").file).parent_path() / model.file;
    if constexpr (requires { model.solid; })
      if (record.good("solid")) read_model(*record.node("solid"), solid_doc, model.solid, out);
    if constexpr (requires { model.problem(); })
      if (const char* problem = model.problem()) out.error(table.key_place, problem);
    into = model;
  });
}

/// Whether a material has, for itself or its solid, an equation of state in a table.
bool has_table_of_states(const Node& material) {
  const Node* eos = material.find("eos");
  const Node* solid = eos ? eos->find("solid") : nullptr;
  const Node* kind = solid ? solid->find("kind") : eos ? eos->find("kind") : nullptr;
  return kind && kind->text == "tabular";
}

Thermal read_thermal(const Node& table, bool tabular, Diagnostics& out) {
  std::vector<Key> keys = thermal_keys();
  for (Key& key : keys) key.required = key.required && !tabular;
  const Record record = read_record(table, keys, out);
  if (tabular && record.has("specific-heat"))
    out.error(record.key_place("specific-heat"), "the table of the equation of state has the specific heat",
              "leave specific-heat out");
  if (tabular && record.text("temperature") == "plastic-work")
    out.error(record.place("temperature"), "the table of the equation of state has the temperature",
              "leave temperature out, or say \"energy\"");
  Thermal thermal;
  take(thermal, record);
  if (record.text("temperature") == "plastic-work") thermal.rule = Thermal::Rule::plastic_work;
  if (thermal.rule == Thermal::Rule::energy && thermal.taylor_quinney != 1)
    out.error(table.find("taylor-quinney")->place,
              "taylor-quinney must be 1 where the temperature follows from the internal energy",
              "leave it out, or choose temperature = \"plastic-work\"");
  return thermal;
}

/// Reads the file of a tabular equation of state, whose state at rest has the initial temperature.
void read_table(const Node& eos, Tabular& model, Thermal& thermal, Diagnostics& out) {
  const Node* file = eos.find("file");
  EosTableFile read = read_eos_table(model.path);
  if (!read.problem.empty()) return out.error(file->place, read.problem, read.help);
  std::string help;
  const double t = thermal.initial_temperature;
  if (std::string problem = model.take(read.table, t, help); !problem.empty())
    return out.error(file->place, model.path.string() + ": " + problem, help);
  constexpr double step = 1;  // K
  thermal.specific_heat =
      (model.table->energy_at(model.rho0, t + step) - model.table->energy_at(model.rho0, t)) / step;
}

/// Porous matter takes what follows from its solid, and has no place for a temperature of its own.
void join_porous(const Record& record, Material& material, Diagnostics& out) {
  auto* porous = std::get_if<Porous>(&material.eos);
  if (!porous) return;
  if (const char* problem = porous->settle())
    out.error(record.node("eos")->key_place, problem, "compare it with its solid and its crush curve");
  if (material.thermal.rule == Thermal::Rule::plastic_work)
    out.error(record.node("thermal")->find("temperature")->place,
              "porous matter has its temperature from the internal energy",
              "leave temperature out, or say \"energy\"");
}

/// The damage of Johnson and Holmquist has constants in common with their strength.
void join_ceramic(const Record& record, Material& material, Diagnostics& out) {
  auto* damage = std::get_if<JohnsonHolmquistDamage>(&material.damage);
  if (!damage) return;
  const auto* strength = std::get_if<JohnsonHolmquist>(&material.strength);
  if (!strength)
    return out.error(record.node("damage")->key_place,
                     "damage of kind \"johnson-holmquist\" needs strength of the same kind",
                     "strength.kind = \"johnson-holmquist\", or another damage model");
  damage->tension = strength->tension;
  damage->hel_pressure = strength->hel_pressure;
}

/// A table of constants without a kind.
template <class Model>
Model read_constants(const Node& table, Diagnostics& out) {
  const std::vector<Key> keys = keys_of_model<Model>(false);
  Model model;
  take(model, read_record(table, keys, out));
  return model;
}

/// The constants of a table that stand beside those of its model.
template <class Model>
Model read_common(const Node& table, Diagnostics& out) {
  const std::vector<Key> keys = keys_of_model<Model>(false);
  return read_constants<Model>(reduced(table,
                                       [&](const std::string& key) {
                                         return std::any_of(keys.begin(), keys.end(),
                                                            [&](const Key& k) { return key == k.name; });
                                       }),
                               out);
}

/// Drops from base's part those keys that the kind chosen by `over` does not have.
template <class Variant>
void keep_common(Node& base, const Node& over, const char* part) {
  const std::string kind = kind_of(over, part);
  Node* table = base.find(part);
  if (!table || kind.empty() || kind == kind_of(base, part)) return;
  for_each_model<Variant>([&](const auto& model) {
    if (kind != model.kind) return;
    const std::vector<Key> common = common_keys<Variant>();
    *table = reduced(std::move(*table), [&](const std::string& key) {
      const auto list = model.parameters();
      return std::any_of(list.begin(), list.end(), [&](const auto& p) { return key == p.name; }) ||
             std::any_of(common.begin(), common.end(), [&](const Key& k) { return key == k.name; });
    });
  });
}

struct Search {
  const config::Document* own;
  const MaterialFolders& folders;
  Diagnostics& out;
  std::vector<std::string> way;  // names met so far, to find circles
};

void report_unknown(const std::string& name, const Search& search, const Place& place) {
  search.out.error(place, "unknown material '" + name + "'",
                   help_for_unknown_material(name, search.own, search.folders));
}

const Node* own_table(const Search& search, const std::string& name) {
  const Node* all = search.own ? search.own->find("material") : nullptr;
  return all ? all->find(name) : nullptr;
}

std::optional<Node> table_of(const std::string& name, Search& search, const Place& place);

/// A table of the case with its base below it.
std::optional<Node> with_base(const Node& table, Search& search) {
  const Node* base_name = table.find("base");
  Node over = reduced(table, [](const std::string& key) { return key != "base"; });
  if (!base_name) return over;
  if (!base_name->is_text()) {
    search.out.error(base_name->place, "'base' must be the name of a material, not " + describe(*base_name));
    return std::nullopt;
  }
  std::optional<Node> base = table_of(base_name->text, search, base_name->place);
  if (!base) return std::nullopt;
  keep_melting(*base, over);  // first: it compares the kinds of strength
  keep_common<Eos>(*base, over, "eos");
  keep_common<Strength>(*base, over, "strength");
  keep_common<Damage>(*base, over, "damage");
  return merged(*base, over);
}

std::optional<Node> table_of(const std::string& name, Search& search, const Place& place) {
  const Node* own = own_table(search, name);
  // A case may call its own variant by the library's name: then its base means the library's.
  const bool met = std::find(search.way.begin(), search.way.end(), name) != search.way.end();
  if (own && !met) {
    if (!own->is_table()) {
      search.out.error(own->place, "'" + own->path + "' must be a table, not " + describe(*own));
      return std::nullopt;
    }
    search.way.push_back(name);
    return with_base(*own, search);
  }
  const std::filesystem::path file = material_file(name, search.folders);
  if (file.empty()) {
    if (met)
      search.out.error(place, "material '" + name + "' is its own base",
                       "name a material of the library; `recoil material list` lists all");
    else
      report_unknown(name, search, place);
    return std::nullopt;
  }
  return read_document(file.string(), search.out).root;
}

template <class Variant>
void add_sections(std::vector<config::Section>& all, const std::string& name, const char* doc) {
  for_each_model<Variant>([&](const auto& model) {
    std::vector<Key> keys = keys_of_model<std::decay_t<decltype(model)>>();
    keys.insert(keys.begin(), kind_key<Variant>(doc));
    for (Key& key : common_keys<Variant>()) keys.push_back(std::move(key));
    all.push_back({name, model.doc, std::move(keys), model.kind});
  });
}

}  // namespace

std::vector<std::string> list_materials(const MaterialFolders& folders) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code failed;
    for (fs::recursive_directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed))
      if (it->path().extension() == ".toml")
        names.push_back(it->path().lexically_relative(folder).replace_extension().generic_string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::filesystem::path material_file(const std::string& name, const MaterialFolders& folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::vector<std::string> names = list_materials({folder});
    if (std::binary_search(names.begin(), names.end(), name)) return folder / (name + ".toml");
  }
  return {};
}

std::optional<Material> read_material(const std::string& name, const Node& table, Diagnostics& out) {
  const int errors = out.error_count();
  std::vector<Key> keys = top_keys(false);
  if (has_table_of_states(table))  // which knows the specific heat
    std::ranges::find(keys, "thermal", &Key::name)->required = false;
  const Record record = read_record(table, keys, out);
  Material material;
  material.name = name;
  material.title = record.text("title");
  material.cite = record.texts("cite");
  material.doubt = record.text("doubt");
  if (record.good("eos")) read_model(*record.node("eos"), eos_doc, material.eos, out);
  if (record.good("strength")) read_model(*record.node("strength"), strength_doc, material.strength, out);
  Tabular* table_of_states = tabular(material.eos);
  Node nothing;
  nothing.kind = Node::Kind::table;
  if (record.good("thermal") || table_of_states)
    material.thermal = read_thermal(record.good("thermal") ? *record.node("thermal") : nothing,
                                    table_of_states != nullptr, out);
  if (table_of_states && out.error_count() == errors) {
    const Node* eos = record.node("eos");
    if (const Node* solid = eos->find("solid")) eos = solid;
    read_table(*eos, *table_of_states, material.thermal, out);
  }
  if (out.error_count() == errors) join_porous(record, material, out);
  if (record.good("damage")) {
    read_model(*record.node("damage"), damage_doc, material.damage, out);
    material.damage_average = read_common<DamageAverage>(*record.node("damage"), out);
  }
  join_ceramic(record, material, out);
  if (record.good("failed")) material.failed = read_constants<FailedMatter>(*record.node("failed"), out);
  if (record.good("melting") && out.error_count() == errors)
    material.melting = read_melting(*record.node("melting"), material, out);
  if (record.good("facts")) material.facts = read_constants<Facts>(*record.node("facts"), out);
  if (is_fluid(material.eos) && has_strength(material.strength))
    out.error(record.node("strength")->key_place, "a gas has no strength",
              "strength = { kind = \"none\" }, or another equation of state");
  if (out.error_count() > errors) return std::nullopt;
  return material;
}

std::optional<Material> find_material(const std::string& name, const config::Document* own,
                                      const MaterialFolders& folders, Diagnostics& out, const Place& place) {
  Search search{own, folders, out, {}};
  const int errors = out.error_count();
  const std::optional<Node> table = table_of(name, search, place);
  if (!table || out.error_count() > errors) return std::nullopt;
  return read_material(name, *table, out);
}

std::vector<config::Section> material_sections() {
  std::vector<config::Section> all;
  all.push_back({"material.*", "a material of this case", top_keys(true)});
  add_sections<Eos>(all, "material.*.eos", eos_doc);
  add_sections<PorousSolid>(all, "material.*.eos.solid", solid_doc);
  add_sections<Strength>(all, "material.*.strength", strength_doc);
  add_sections<Damage>(all, "material.*.damage", damage_doc);
  all.push_back({"material.*.failed", failed_doc, keys_of_model<FailedMatter>()});
  all.push_back({"material.*.thermal", "heat and temperature", thermal_keys()});
  all.push_back({"material.*.melting", melting_doc, keys_of_model<Melting>(false)});
  all.push_back({"material.*.facts", "for checks of plausibility only", keys_of_model<Facts>(false)});
  return all;
}

}  // namespace recoil
