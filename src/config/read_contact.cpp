#include "config/read_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/read_body.hpp"

namespace recoil::config {

namespace {

/// `mode_key`: "default" or "mode". A coefficient and the mode that needs it must come together.
ContactChoice read_choice(const Record& record, const char* mode_key, Diagnostics& out) {
  ContactChoice choice;
  const std::string& mode = record.text(mode_key);
  using enum ContactChoice::Mode;
  choice.mode = mode == "bonded" ? bonded : mode == "friction" ? friction : separable;
  choice.friction = record.has("friction") ? record.number("friction") : 0;
  if (record.has("friction") && (record.good(mode_key) || !record.has(mode_key)) && choice.mode != friction)
    out.error(record.key_place("friction"),
              fmt::format("'friction' means nothing for {} = \"{}\"", mode_key, mode),
              fmt::format("write {} = \"friction\", or take it out", mode_key));
  if (choice.mode == friction && !record.has("friction"))
    out.error(record.place(mode_key), "friction needs a coefficient", "e.g. friction = 0.3");
  return choice;
}

}  // namespace

ContactChoice Contact::between(const std::string& a, const std::string& b) const {
  for (const Pair& p : pairs)
    if ((p.bodies[0] == a && p.bodies[1] == b) || (p.bodies[0] == b && p.bodies[1] == a)) return p.choice;
  return usual;
}

Contact read_contact(const Node& node, const std::vector<Body>& bodies, Diagnostics& out) {
  Contact contact;
  const Record record = read_record(node, keys_of("contact"), out);
  contact.usual = read_choice(record, "default", out);
  const Node* pairs = record.node("pairs");
  if (!pairs) return contact;
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  for (const Node& pair : pairs->children) {
    Contact::Pair p;
    p.bodies = read_pair(pair.key, pair.key_place, names, out);
    if (!pair.is_table()) {
      out.error(pair.place, fmt::format("'{}' is no table", pair.key),
                fmt::format("e.g. {} = {{ mode = \"friction\", friction = 0.3 }}", pair.key));
      continue;
    }
    p.choice = read_choice(read_record(pair, keys_of("contact.pairs.*"), out), "mode", out);
    const bool again = std::any_of(contact.pairs.begin(), contact.pairs.end(), [&](const Contact::Pair& q) {
      return !p.bodies[0].empty() &&
             (q.bodies == p.bodies || q.bodies == std::array{p.bodies[1], p.bodies[0]});
    });
    if (again) out.error(pair.key_place, fmt::format("the pair '{}' stands here twice", pair.key));
    contact.pairs.push_back(p);
  }
  return contact;
}

}  // namespace recoil::config
