#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace recoil::config {

/// A surface of triangles that share their corners.
struct Triangles {
  std::vector<Vec<3>> points;               // m
  std::vector<std::array<int, 3>> corners;  // of each triangle, counter-clockwise seen from outside
};

/// What is wrong with a surface, and the cure; empty where nothing is.
struct SurfaceFault {
  std::string problem, help;
};

/// Whether a surface encloses a volume: every edge belongs to two triangles, which run through it in opposite
/// directions, and the outside lies where the corners turn counter-clockwise. Surfaces that cut themselves
/// are not found.
SurfaceFault fault_of(const Triangles& surface);

/// What the triangles enclose, taken positive where they turn counter-clockwise seen from outside [m3].
double volume_of(const Triangles& surface);

/// Signed distance to a closed surface. Exact, with gradient 1: the nearest place is found in a tree of
/// boxes, and the sign follows from the normal there, on an edge the sum of the normals beside it, in a
/// corner that of the normals around it weighted with the angles of their triangles (Baerentzen & Aanaes,
/// IEEE Trans. Vis. Comput. Graph. 11, 2005).
class ClosedSurface {
 public:
  /// @param surface one without a fault.
  explicit ClosedSurface(Triangles surface);

  double distance(const Vec<3>& x) const;  // m, negative inside
  const Vec<3>& lo() const { return nodes_.front().lo; }
  const Vec<3>& hi() const { return nodes_.front().hi; }

 private:
  /// Parts of a triangle that a nearest place can lie on: corners a, b, c, edges ab, bc, ca, and the face.
  static constexpr int face = 6;
  struct Nearest {
    double distance2 = std::numeric_limits<double>::infinity();
    Vec<3> point;
    int triangle = 0, part = face;
  };
  /// A box around triangles: of `order_` those from `first`, or none and the boxes after it and at `other`.
  struct Node {
    Vec<3> lo, hi;
    int first = 0, count = 0, other = 0;
  };

  void find_normals();
  int build(int first, int count);
  void search(int node, const Vec<3>& x, Nearest& best) const;
  Nearest nearest_on(int triangle, const Vec<3>& x) const;

  Triangles surface_;
  std::vector<std::array<Vec<3>, 4>> normals_;  // of each triangle: on its edges ab, bc, ca and its face
  std::vector<Vec<3>> corner_normals_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace recoil::config
