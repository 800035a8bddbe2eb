#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/shape/outline.hpp"
#include "config/shape/round/line.hpp"

namespace recoil::config {

/// Signed distance to what a closed profile of corners (radius, along) sweeps about its axis [m]. Exact: the
/// nearest place of a body of revolution lies in the same half plane. Edges on the axis are no surface.
double profile_distance(std::span<const Corner> profile, const Meridian& at);

/// A profile joined to the axis by flat faces; one that ends where it begins is a ring, and stays as it is.
std::vector<Corner> joined_to_axis(std::vector<Corner> profile);

/// A body of revolution.
struct Revolution {
  std::vector<Corner> profile;  // m, (radius, along), closed
  Vector centre{};              // m, where `along` is 0
  Vector axis{0, 0, 1};         // 3d: unit vector

  static constexpr const char* kind = "revolution";
  static constexpr const char* doc =
      "A body of revolution: a profile turned about an axis, axisymmetric about r = 0.";
  static std::vector<Geometry> only_in() { return {Geometry::axisymmetric, Geometry::space}; }
  static Entries<Revolution> keys();
  void check(const TableReading& reading) const;

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    return profile_distance(profile, about(x, first_components<Dim>(centre), own_axis<Dim>(axis)));
  }
  Bounds bounds(const Domain& domain) const;

 private:
  static void read_profile(Revolution& shape, const TableReading& reading, const Key& key);
  static std::string write_profile(const Revolution& shape, const char* name, const Writing& how);
};

}  // namespace recoil::config
