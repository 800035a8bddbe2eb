#include "picture/space/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/turn.hpp"

namespace recoil {

namespace {

constexpr double steepest = 1.5;

struct Corner {
  Vec<3> x;
  double distance = 0;
  bool inside() const { return distance < 0; }
};

/// Where the surface crosses an edge; the same to the bit from both sides.
Vec<3> crossing(const Corner& a, const Corner& b) {
  const Corner& in = a.inside() ? a : b;
  const Corner& out = a.inside() ? b : a;
  const double part = in.distance / (in.distance - out.distance);
  return in.x + part * (out.x - in.x);
}

class Mesher {
 public:
  Mesher(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box, double width)
      : distance_(distance), box_(box), width_(width) {
    for (int d = 0; d < 3; ++d) origin_[d] = box.lo[d] - 0.5 * width;  // one layer of corners outside
  }

  /// Halves the longest side of lo .. hi, in cells, down to single cells.
  void search(const std::array<int, 3>& lo, const std::array<int, 3>& hi) {
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (hi[d] - lo[d] > hi[axis] - lo[axis]) axis = d;
    if (hi[axis] - lo[axis] == 1) {
      add_cell(lo);
      return;
    }
    const Vec<3> a = place(lo), b = place(hi);
    if (std::abs(at(0.5 * (a + b))) > steepest * 0.5 * norm(b - a)) return;
    std::array<int, 3> middle_hi = hi, middle_lo = lo;
    middle_hi[axis] = middle_lo[axis] = (lo[axis] + hi[axis]) / 2;
    search(lo, middle_hi);
    search(middle_lo, hi);
  }

  std::vector<Triangle> triangles;

 private:
  Vec<3> place(const std::array<int, 3>& i) const {
    Vec<3> x;
    for (int d = 0; d < 3; ++d) x[d] = origin_[d] + i[static_cast<std::size_t>(d)] * width_;
    return x;
  }
  /// The distance of the part of the body in the box.
  double at(const Vec<3>& x) const {
    double d = distance_(x);
    for (int k = 0; k < 3; ++k) d = std::max({d, box_.lo[k] - x[k], x[k] - box_.hi[k]});
    return d;
  }

  void add_cell(const std::array<int, 3>& i) {
    std::array<Corner, 8> c;
    for (std::size_t n = 0; n < 8; ++n) {
      const int bits = static_cast<int>(n);
      c[n].x = place({i[0] + (bits & 1), i[1] + (bits >> 1 & 1), i[2] + (bits >> 2 & 1)});
      c[n].distance = at(c[n].x);
    }
    // Six tetrahedra around the diagonal: the same diagonals on both sides of every face.
    constexpr std::array<std::array<std::size_t, 2>, 6> ways{
        {{{1, 3}}, {{3, 2}}, {{2, 6}}, {{6, 4}}, {{4, 5}}, {{5, 1}}}};
    for (const auto& way : ways) add_tetrahedron({&c[0], &c[way[0]], &c[way[1]], &c[7]});
  }

  void add_tetrahedron(std::array<const Corner*, 4> c) {
    std::stable_partition(c.begin(), c.end(), [](const Corner* p) { return p->inside(); });
    const auto inside = std::ranges::count_if(c, [](const Corner* p) { return p->inside(); });
    if (inside == 0 || inside == 4) return;
    const Vec<3> outwards = c[3]->x - c[0]->x;
    if (inside == 1) {
      add({crossing(*c[0], *c[1]), crossing(*c[0], *c[2]), crossing(*c[0], *c[3])}, outwards);
    } else if (inside == 3) {
      add({crossing(*c[0], *c[3]), crossing(*c[1], *c[3]), crossing(*c[2], *c[3])}, outwards);
    } else {
      const Vec<3> p = crossing(*c[0], *c[2]), q = crossing(*c[0], *c[3]), r = crossing(*c[1], *c[3]),
                   s = crossing(*c[1], *c[2]);
      add({p, q, r}, outwards);
      add({p, r, s}, outwards);
    }
  }

  /// A triangle of a plane that has c[0] on one side and c[3] on the other. One without area is no loss: its
  /// two long sides are one edge.
  void add(Triangle t, const Vec<3>& outwards) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    if (dot(cross(t[1] - t[0], t[2] - t[0]), outwards) < 0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }

  const std::function<double(const Vec<3>&)>& distance_;
  SpaceBox box_;
  double width_;
  Vec<3> origin_;
};

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::vector<Triangle> surface_mesh(const std::function<double(const Vec<3>&)>& distance, const SpaceBox& box,
                                   double width) {
  std::array<int, 3> cells{};
  for (std::size_t d = 0; d < 3; ++d) {
    const int k = static_cast<int>(d);
    cells[d] = static_cast<int>(std::ceil((box.hi[k] - box.lo[k]) / width)) + 1;
  }
  Mesher mesher(distance, box, width);
  mesher.search({0, 0, 0}, cells);
  return mesher.triangles;
}

std::string stl_bytes(const std::vector<Triangle>& triangles, const std::string& name) {
  std::string bytes = name.substr(0, 79);
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    const Vec<3> normal = unit(cross(t[1] - t[0], t[2] - t[0]));
    for (const Vec<3>& v : {normal, t[0], t[1], t[2]})
      for (int d = 0; d < 3; ++d) append(bytes, static_cast<float>(v[d]));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace recoil
