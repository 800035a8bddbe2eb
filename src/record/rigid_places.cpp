#include "record/rigid_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

#include "core/error.hpp"

namespace recoil {

namespace {

constexpr const char* number_array = "rigid_body";

/// What is kept of a body, apart from its number: the rows of a matrix, or a single one.
struct Column {
  const char* name;
  int rows;
  Vec<3>& (*row)(RigidPlace&, std::size_t);
};

constexpr std::array<Column, 5> columns{
    {{"rigid_start_centre_m", 1, [](RigidPlace& p, std::size_t) -> Vec<3>& { return p.start_centre; }},
     {"rigid_centre_m", 1, [](RigidPlace& p, std::size_t) -> Vec<3>& { return p.pose.centre; }},
     {"rigid_rotation", 3, [](RigidPlace& p, std::size_t row) -> Vec<3>& { return p.pose.turn[row]; }},
     {"rigid_velocity_m_per_s", 1, [](RigidPlace& p, std::size_t) -> Vec<3>& { return p.velocity; }},
     {"rigid_spin_rad_per_s", 1, [](RigidPlace& p, std::size_t) -> Vec<3>& { return p.spin; }}}};

template <int Dim>
Vec<3> in_space(const Vec<Dim>& x) {
  Vec<3> y;
  for (int d = 0; d < Dim; ++d) y[d] = x[d];
  return y;
}

const NamedArray* array_named(const UnstructuredGrid& grid, std::string_view name) {
  const auto at = std::ranges::find(grid.whole_arrays, name, &NamedArray::name);
  return at == grid.whole_arrays.end() ? nullptr : &*at;
}

}  // namespace

template <int Dim>
std::vector<RigidPlace> rigid_places(const State<Dim>& state) {
  std::vector<RigidPlace> places;
  for (std::size_t m = 0; m < state.bodies.size(); ++m) {
    const auto& motion = state.bodies[m].rigid;
    if (!motion) continue;
    places.push_back({static_cast<int>(m),
                      in_space(motion->start_centre),
                      {in_space(motion->centre), motion->turn},
                      in_space(motion->velocity),
                      motion->spin});
  }
  return places;
}

std::vector<NamedArray> rigid_arrays(const std::vector<RigidPlace>& places) {
  if (places.empty()) return {};
  std::vector<std::int32_t> numbers;
  for (const RigidPlace& p : places) numbers.push_back(p.body);
  std::vector<NamedArray> arrays{{number_array, 1, std::move(numbers)}};
  for (const Column& column : columns) {
    std::vector<double> values;
    for (RigidPlace p : places)
      for (int row = 0; row < column.rows; ++row)
        for (int d = 0; d < 3; ++d) values.push_back(column.row(p, static_cast<std::size_t>(row))[d]);
    arrays.push_back({column.name, 3 * column.rows, std::move(values)});
  }
  return arrays;
}

std::vector<RigidPlace> rigid_places_in(const UnstructuredGrid& grid) {
  const NamedArray* numbers = array_named(grid, number_array);
  if (numbers == nullptr) return {};
  std::vector<RigidPlace> places;
  for (const double m : as_doubles(numbers->values)) places.push_back({static_cast<int>(m), {}, {}, {}, {}});
  for (const Column& column : columns) {
    const NamedArray* array = array_named(grid, column.name);
    const std::vector<double> values = array ? as_doubles(array->values) : std::vector<double>{};
    if (values.size() != places.size() * 3 * static_cast<std::size_t>(column.rows))
      throw InputError(fmt::format("error: the dump holds {} rigid bodies, but {} values of '{}'",
                                   places.size(), values.size(), column.name));
    auto from = values.begin();
    for (RigidPlace& p : places)
      for (int row = 0; row < column.rows; ++row)
        for (int d = 0; d < 3; ++d) column.row(p, static_cast<std::size_t>(row))[d] = *from++;
  }
  return places;
}

#define RECOIL_INSTANTIATE(Dim) template std::vector<RigidPlace> rigid_places<Dim>(const State<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
