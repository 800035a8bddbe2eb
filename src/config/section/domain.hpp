#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

/// axis: r = 0 of an axisymmetric or spherical domain (same as symmetry, chosen by itself).
enum class Boundary { outflow, symmetry, periodic, axis };

/// What lies beyond the edges: [axis][low, high].
struct Boundaries : std::array<std::array<Boundary, 2>, 3> {
  static constexpr const char* doc =
      "What lies beyond the edges: one kind for both ends of an axis, or [low, high].";
  static Entries<Boundaries> keys();
};

struct Domain {
  Geometry geometry = Geometry::line;
  Vector lo{}, hi{};  // m
  Boundaries boundary{};

  static constexpr const char* doc = "The box of space that is computed.";
  static Entries<Domain> keys();
  void check(const TableReading& reading) const;
};

/// The geometry that the table of a domain names; of a wrong or missing name the one that its keys suggest.
Geometry geometry_of(const Node& domain);

/// Reads [domain]; `in` learns where it lies.
void read_domain(const Node& node, Domain& domain, CaseReading& in);

}  // namespace recoil::config
