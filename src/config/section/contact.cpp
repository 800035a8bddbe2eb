#include "config/section/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "config/declare/part.hpp"

namespace recoil::config {

namespace {

void add_pair_sections(const std::string& path, std::vector<Section>& all) {
  add_sections<ContactChoice>(path + ".*", all);
}

/// The keys of [contact]: those of a pair, and the pairs that differ, which read_contact() reads.
Entries<ContactChoice> keys_of_contact() {
  Entries<ContactChoice> keys = ContactChoice::keys(
      "default",
      "between all bodies that [contact.pairs] does not name. separable: frictionless, pressed together or "
      "apart, never pulled; bonded: glued from the first touch on; friction: separable, with Coulomb "
      "friction");
  keys.push_back({.name = "pairs",
                  .member = Part<ContactChoice>{nullptr, add_pair_sections, nullptr},
                  .doc = "what holds between two bodies: NAME-NAME = { mode = ..., friction = ... }"});
  return keys;
}

}  // namespace

void ContactChoice::check(const TableReading& reading) const {
  const std::string key = reading.keys.front().name;
  if (reading.has("friction") && (reading.good(key) || !reading.has(key)) && mode != Mode::friction)
    reading.refuse("friction",
                   fmt::format("'friction' does not apply to {} = \"{}\"", key, reading.record.text(key)),
                   fmt::format("write {} = \"friction\", or remove it", key));
  if (mode == Mode::friction && !reading.has("friction"))
    reading.wrong(key, "friction needs a coefficient", "e.g. friction = 0.3");
}

ContactChoice Contact::between(const std::string& a, const std::string& b) const {
  for (const Pair& p : pairs)
    if ((p.bodies[0] == a && p.bodies[1] == b) || (p.bodies[0] == b && p.bodies[1] == a)) return p.choice;
  return usual;
}

void read_contact(const Node& node, Contact& contact, const CaseReading& in) {
  const Record record = read_struct(node, contact.usual, in, {}, keys_of_contact());
  if (!record.good("pairs")) return;
  for (const Node& pair : node.find("pairs")->children) {
    Contact::Pair p;
    p.bodies = read_pair(pair.key, pair.key_place, in.bodies, in.out);
    if (!pair.is_table()) {
      in.out.error(pair.place, fmt::format("'{}' is not a table", pair.key),
                   fmt::format("e.g. {} = {{ mode = \"friction\", friction = 0.3 }}", pair.key));
      continue;
    }
    read_struct(pair, p.choice, in);
    const bool again = std::any_of(contact.pairs.begin(), contact.pairs.end(), [&](const Contact::Pair& q) {
      return !p.bodies[0].empty() &&
             (q.bodies == p.bodies || q.bodies == std::array{p.bodies[1], p.bodies[0]});
    });
    if (again)
      in.out.error(pair.key_place, fmt::format("the pair '{}' is given twice", pair.key),
                   "leave one of them out: the order of the names does not matter");
    contact.pairs.push_back(p);
  }
}

void add_contact_sections(const std::string& path, std::vector<Section>& all) {
  const std::size_t own = all.size();
  add_sections<ContactChoice>(path, all, keys_of_contact());
  all[own].doc = Contact::doc;
}

void write_contact(const Contact& contact, const std::string& path, const Writing& how,
                   std::vector<WrittenTable>& all) {
  all.push_back({path, written_keys(contact.usual, how, keys_of_contact())});
  for (const Contact::Pair& p : contact.pairs)
    all.push_back({path + ".pairs." + p.bodies[0] + '-' + p.bodies[1], written_keys(p.choice, how)});
}

}  // namespace recoil::config
