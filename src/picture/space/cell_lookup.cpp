#include "picture/space/cell_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace recoil {

namespace {

constexpr int side = 8;  // places along a brick
constexpr std::size_t places = 512;

/// Extent of a cell along the three axes [m].
SpaceBox box_of(const UnstructuredGrid& grid, std::size_t cell) {
  constexpr double far = std::numeric_limits<double>::infinity();
  SpaceBox box{{{far, far, far}}, {{-far, -far, -far}}};
  for (auto k = grid.offsets[cell]; k < grid.offsets[cell + 1]; ++k) {
    const double* p = grid.points.data() + 3 * grid.connectivity[static_cast<std::size_t>(k)];
    for (int d = 0; d < 3; ++d) {
      box.lo[d] = std::min(box.lo[d], p[d]);
      box.hi[d] = std::max(box.hi[d], p[d]);
    }
  }
  return box;
}

void widen(SpaceBox& all, const SpaceBox& box) {
  for (int d = 0; d < 3; ++d) {
    all.lo[d] = std::min(all.lo[d], box.lo[d]);
    all.hi[d] = std::max(all.hi[d], box.hi[d]);
  }
}

}  // namespace

CellLookup::CellLookup(const UnstructuredGrid& grid) {
  dx_ = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < grid.cells(); ++n) {
    if (grid.types[n] != static_cast<unsigned char>(VtkCell::hexahedron))
      throw InputError("the fields are not those of a run in space (geometry = \"3d\")");
    const SpaceBox box = box_of(grid, n);
    lower_.push_back(box.lo);
    width_.push_back(box.hi[0] - box.lo[0]);
    dx_ = std::min(dx_, width_.back());
    if (n == 0) box_ = box;
    widen(box_, box);
  }
  if (lower_.empty()) throw InputError("the fields of that time hold no cell");
  std::size_t all = 1;
  for (int d = 0; d < 3; ++d) {
    bricks_[d] = static_cast<int>(std::lround((box_.hi[d] - box_.lo[d]) / dx_)) / side + 1;
    all *= static_cast<std::size_t>(bricks_[d]);
  }
  brick_.assign(all, -1);
  for (int n = 0; n < static_cast<int>(lower_.size()); ++n) {
    std::array<int, 3> first{};
    for (int d = 0; d < 3; ++d) first[d] = static_cast<int>(std::lround((lower(n)[d] - box_.lo[d]) / dx_));
    enter(n, first, static_cast<int>(std::lround(width(n) / dx_)));
  }
}

void CellLookup::enter(int cell, const std::array<int, 3>& first, int width) {
  const auto covers = [&](int d, int b) {
    return first[d] <= side * b && first[d] + width >= side * (b + 1);
  };
  for (int c = first[2] / side; c <= (first[2] + width - 1) / side; ++c)
    for (int b = first[1] / side; b <= (first[1] + width - 1) / side; ++b)
      for (int a = first[0] / side; a <= (first[0] + width - 1) / side; ++a) {
        std::int32_t& brick =
            brick_[static_cast<std::size_t>(a + bricks_[0] * b) +
                   static_cast<std::size_t>(bricks_[0] * bricks_[1]) * static_cast<std::size_t>(c)];
        if (covers(0, a) && covers(1, b) && covers(2, c)) {
          brick = -2 - cell;
          continue;
        }
        if (brick < 0) {
          brick = static_cast<std::int32_t>(place_.size() / places);
          place_.resize(place_.size() + places, -1);
        }
        std::int32_t* to = place_.data() + places * static_cast<std::size_t>(brick);
        const auto from = [&](int d, int n) { return std::max(first[d] - side * n, 0); };
        const auto end = [&](int d, int n) { return std::min(first[d] + width - side * n, side); };
        for (int k = from(2, c); k < end(2, c); ++k)
          for (int j = from(1, b); j < end(1, b); ++j)
            for (int i = from(0, a); i < end(0, a); ++i) to[i + side * (j + side * k)] = cell;
      }
}

int CellLookup::at(const Vec<3>& x) const {
  std::array<int, 3> i{};
  for (int d = 0; d < 3; ++d) {
    if (!(x[d] >= box_.lo[d] && x[d] <= box_.hi[d])) return -1;
    const double inside = std::min(x[d], box_.hi[d] - 1e-3 * dx_);
    i[d] = static_cast<int>((inside - box_.lo[d]) / dx_);
  }
  const std::int32_t brick =
      brick_[static_cast<std::size_t>(i[0] / side + bricks_[0] * (i[1] / side)) +
             static_cast<std::size_t>(bricks_[0] * bricks_[1]) * static_cast<std::size_t>(i[2] / side)];
  if (brick < 0) return brick == -1 ? -1 : -2 - brick;
  return place_[places * static_cast<std::size_t>(brick) +
                static_cast<std::size_t>(i[0] % side + side * (i[1] % side + side * (i[2] % side)))];
}

CellLookup::Corners CellLookup::around(const Vec<3>& x) const {
  const int own = at(x);
  const double h = own < 0 ? dx_ : width(own);
  const Vec<3> base = own < 0 ? box_.lo : lower(own);
  std::array<std::array<double, 2>, 3> middle{}, weight{};
  for (int d = 0; d < 3; ++d) {
    const double u = (x[d] - base[d]) / h - 0.5, below = std::floor(u);
    for (int s = 0; s < 2; ++s) {
      // A hair beside the middle: where cells are finer, that is a corner of theirs.
      const double place = base[d] + (below + s + 0.5 + 1e-6) * h;
      middle[d][s] = std::clamp(place, box_.lo[d], box_.hi[d]);
      weight[d][s] = s == 0 ? 1 - (u - below) : u - below;
    }
  }
  Corners corners{};
  for (int n = 0; n < 8; ++n) {
    const int a = n & 1, b = n >> 1 & 1, c = n >> 2 & 1;
    corners.cell[n] = at({{middle[0][a], middle[1][b], middle[2][c]}});
    corners.weight[n] = weight[0][a] * weight[1][b] * weight[2][c];
  }
  return corners;
}

}  // namespace recoil
