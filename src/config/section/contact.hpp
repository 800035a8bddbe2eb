#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

/// What holds where two bodies meet.
struct ContactChoice {
  enum class Mode { separable, bonded, friction };
  Mode mode = Mode::separable;
  double friction = 0;  // Coulomb's coefficient

  static constexpr const char* doc = "What happens where two bodies meet.";
  /// @param name, where of the key of the mode: the default has another name.
  static Entries<ContactChoice> keys(const char* name = "mode", const char* doc = mode_doc) {
    return {{.name = name,
             .member = choice_of<&ContactChoice::mode>(),
             .doc = doc,
             .example = R"("separable")",
             .choices = {"separable", "bonded", "friction"}},
            {.name = "friction",
             .member = &ContactChoice::friction,
             .least = 0,
             .most = 10,
             .optional = true,
             .doc = "Coulomb's coefficient: largest shear traction over pressure",
             .example = "0.3",
             .when = [](const ContactChoice& c) { return c.mode == Mode::friction; }}};
  }
  /// A coefficient and the mode that needs it must come together.
  void check(const TableReading& reading) const;

  static constexpr const char* mode_doc =
      "between these two. separable: frictionless, pressed together or apart, never pulled; bonded: glued "
      "from the first touch on; friction: separable, with Coulomb friction";
};

struct Contact {
  struct Pair {
    std::array<std::string, 2> bodies;
    ContactChoice choice;
  };
  ContactChoice usual;
  std::vector<Pair> pairs;  // that differ

  ContactChoice between(const std::string& a, const std::string& b) const;

  static constexpr const char* doc = "What happens where bodies meet.";
};

void read_contact(const Node& node, Contact& contact, const CaseReading& in);
void add_contact_sections(const std::string& path, std::vector<Section>& all);
void write_contact(const Contact& contact, const std::string& path, const Writing& how,
                   std::vector<WrittenTable>& all);

}  // namespace recoil::config
