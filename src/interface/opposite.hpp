#pragma once

#include <vector>

#include "core/scratch.hpp"
#include "cutcell/geometry.hpp"

namespace recoil {

/// Level sets, contact bits and walls around one block, as the ghost-fluid schemes look at them.
template <int Dim>
struct SurfaceView {
  State<Dim>& state;
  int slot;
  Window<Dim> window;
  std::vector<const double*> phi;             // by body, in the window; null where absent
  std::vector<const std::uint8_t*> role;      // of deformable bodies
  std::vector<const std::uint32_t*> contact;  // of deformable bodies
  std::vector<const int*> wall;               // places in BodyBlock::walls, of deformable bodies

  double dx() const { return state.grid().dx; }
  const Body<Dim>& body(int m) const { return state.bodies[m]; }
  /// phi of a body at x [m].
  double distance(int m, const Vec<Dim>& x) const;
  /// Outward normal of a body at cell i.
  Vec<Dim> normal(int m, const Index<Dim>& i) const;
  /// Whether a body touched a partner in the last step in cell i.
  bool touched(int m, int partner, const Index<Dim>& i) const {
    const std::uint32_t* bits = contact[m];
    return bits && (bits[window.at(i)] >> partner & 1U) != 0;
  }
  /// The same in cell i or one around it.
  bool was_in_contact(int m, int partner, const Index<Dim>& i) const;
};

/// Cells that a SurfaceView shows around the block.
inline constexpr int view_reach = 3;

template <int Dim>
SurfaceView<Dim> view_surfaces(State<Dim>& state, int slot, PhiAt when, Scratch& scratch);

/// What stands opposite to a surface point.
template <int Dim>
struct Opposite {
  int body = -1;            // -1: nothing within dx
  double gap = 0;           // [m], its level set at the point
  Vec<Dim> normal;          // out of that body
  Primitives<Dim> value{};  // its fitted state, continued to the point; not of a rigid one

  /// Whether the surface with outward normal n faces it.
  bool faces(const Vec<Dim>& n) const { return body >= 0 && dot(n, normal) < -0.7; }
};

/// The body other than m that is nearest to a surface point x of cell i.
template <int Dim>
Opposite<Dim> find_opposite(const SurfaceView<Dim>& v, int m, const Vec<Dim>& x, const Index<Dim>& i);

/// Direction of the contact of a surface with outward normal n: away from the partner if that is rigid, else
/// between the two normals.
template <int Dim>
Vec<Dim> contact_normal(const SurfaceView<Dim>& v, const Opposite<Dim>& o, const Vec<Dim>& n) {
  return v.body(o.body).rigid ? -o.normal : unit(n - o.normal);
}

/// Empties what the last stage saw of the pairs of bodies; what they have exchanged so far stays.
template <int Dim>
void clear_records(State<Dim>& state, int slot);

/// Books what a wall in contact gives to body m, once for each pair: on the side of the lower-numbered body,
/// or of the deformable one.
/// @param booked time that this stage stands for [s]; 0: nothing is recorded.
template <int Dim>
void record_contact(const SurfaceView<Dim>& v, int m, const Opposite<Dim>& o, const CutCell<Dim>& cut,
                    const Vec<Dim>& e, double traction, double work_velocity, double booked);

}  // namespace recoil
