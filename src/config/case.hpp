#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/diagnostics.hpp"

/// What a case file says, checked and in SI. Vectors carry three components whatever the geometry:
/// 1d uses [0] = x; planar [0] = x, [1] = y; axisymmetric [0] = r, [1] = z; 3d all.
namespace recoil::config {

using Vector = std::array<double, 3>;

enum class Geometry { line, planar, axisymmetric, space };

/// 1, 2 or 3.
constexpr int dimension(Geometry g) { return g == Geometry::line ? 1 : g == Geometry::space ? 3 : 2; }

/// axis: r = 0 of an axisymmetric domain (same as symmetry, chosen by itself).
enum class Boundary { outflow, symmetry, periodic, axis };

struct Domain {
  Geometry geometry = Geometry::line;
  Vector lo{}, hi{};                                  // m
  std::array<std::array<Boundary, 2>, 3> boundary{};  // [axis][low, high]
};

struct MeshChoice {
  double finest = 0;  // m, cell size
  double offset = 0;  // the mesh is shifted by this fraction of a cell
  int block = 0;      // cells of a block along each axis; 0: chosen by the mesh
};

struct TimeChoice {
  double end = 0;                  // s
  double cfl = 0.9;                //
  std::optional<double> fixed_dt;  // s
};

/// A region of space. Only the members that the kind names are used.
struct Shape {
  enum class Kind { box, cylinder, sphere, half_space, polygon, combined, difference };
  Kind kind = Kind::box;
  Vector lo{}, hi{};    // box (1d: an interval), before rotation
  double rotation = 0;  // rad, counter-clockwise about `centre`: box, polygon (planar, axisymmetric)
  Vector centre{};      // sphere, disc (planar cylinder), centre of rotation
  double radius = 0;    // sphere, cylinder
  Vector axis{};        // cylinder in 3d: unit vector along its axis
  double length_lo = 0,
         length_hi = 0;      // cylinder in 3d: extent along its axis from centre; axisymmetric: z range
  Vector point{}, normal{};  // half space: matter where (x - point) . normal < 0; unit normal
  std::vector<std::array<double, 2>> vertices;  // polygon, either orientation (planar, axisymmetric)
  std::vector<Shape> parts;  // combined: union of all; difference: the first without the others
  Place place;
};

struct Body {
  std::string name;
  std::string material;  // a library name or a [material.NAME] of this case; empty: rigid
  bool rigid = false;
  double mass = 0;          // of a free rigid body [kg; kg/m planar; kg/m2 1d]; 0: keeps its velocity
  Vector inertia{};         // kg m2 (planar: kg m, [2] only), about the centre of mass, along the axes
  Vector centre_of_mass{};  // m
  Shape shape;
  Vector velocity{};     // m/s
  Vector spin{};         // rad/s about spin_centre; planar: [2] only
  Vector spin_centre{};  // m
  Place place, material_place;
};

struct Gauge {
  enum class Kind { surface_velocity, point, body, contact, bar, attitude, peak_stress };
  std::string name;
  Kind kind = Kind::body;
  std::string body;                 // surface_velocity, point, body
  std::array<std::string, 2> pair;  // contact
  Vector at{};                      // m: surface_velocity, point
  double every = 0;                 // s; 0: every step
  Place place;
  double radius = 0;   // m: contact, only what lies so near to `at`; 0: all of it
  Vector direction{};  // contact: unit vector along which force and impulse are also given; zero: none
  std::string wall;    // bar: what its foot stands on
  Vector to{};         // m: end of the line of a peak_stress
  int stations = 0;    // on that line
};

struct Output {
  double fields_every = 0;             // s; 0: none but first and last
  std::vector<std::string> variables;  // names of fields to write
  double history_every = 0;            // s; 0: every step
};

/// What holds where two bodies meet.
struct ContactChoice {
  enum class Mode { separable, bonded, friction };
  Mode mode = Mode::separable;
  double friction = 0;  // Coulomb's coefficient
};

struct Contact {
  struct Pair {
    std::array<std::string, 2> bodies;
    ContactChoice choice;
  };
  ContactChoice usual;
  std::vector<Pair> pairs;  // that differ

  ContactChoice between(const std::string& a, const std::string& b) const;
};

struct Method {
  std::string scheme = "conservative";  // conservative, ghost-fluid, seed
  double kappa = 0.5;                   // [dx] distance at which bodies meet; seed only
};

/// One acceptance check of [expect] or expected.toml.
struct Expectation {
  std::string quantity;                    // e.g. "gauge.rear.velocity@3.8us"
  bool is_flag = false, flag = false;      // a true/false expectation
  double value = 0;                        // SI
  double tolerance = 0;                    // SI, absolute
  bool at_most = false, at_least = false;  // one-sided checks: only `value` counts
  std::string unit;                        // as written, to print with
  std::string source, why;
  Place place;
};

/// One [material.NAME] of the case, or one file of the library: read by material/library with the
/// key lists of its models. `toml` is the table's own text node, kept opaque here.
struct Case {
  std::string file;  // path as given
  std::string text;  // the file's content
  int format = 1;
  std::string title;
  std::vector<std::string> cite;
  Domain domain;
  MeshChoice mesh;
  TimeChoice time;
  std::vector<Body> bodies;
  std::vector<Gauge> gauges;
  Output output;
  Method method;
  Contact contact;
  std::vector<Expectation> expect;
};

}  // namespace recoil::config
