#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gauge/totals.hpp"

namespace recoil {

/// How far the centre of mass of a body is from where its momentum has carried it.
struct CentreOff {
  std::string name;
  double off = 0;   ///< m
  double way = 0;   ///< m, the length of the way that its momentum has carried it until then
  double time = 0;  ///< s

  template <class Archive>
  void transfer(Archive& a) {
    a(name, off, way, time);
  }
};

/// Compares the centre of mass of each deformable body with where the integral of its momentum over time has
/// brought it. No balance sees matter that has momentum and does not move, or moves without: mass, momentum
/// and energy are in some cell all the same. It holds whatever pushes the body, also at edges where matter
/// leaves. Axes that are periodic, and r of axisymmetric bodies, are left out.
template <int Dim>
class CentreWatch {
 public:
  /// @param names of all bodies; @param rigid which of them are not looked at; @param balanced the axes that
  /// count; @param fragments_of Body::fragments_of: a body is looked at together with what others have taken
  /// up of it. Empty: none has.
  CentreWatch(const std::vector<std::string>& names, const std::vector<bool>& rigid,
              std::vector<bool> balanced, const std::vector<int>& fragments_of = {});

  void begin(const Totals<Dim>& start);
  /// Between two looks momentum is taken as linear in time. What it could carry further by a change at the
  /// earliest or latest moment between them is not counted as an error.
  void look(const Totals<Dim>& totals);

  /// The largest distance at any look so far, of each deformable body.
  const std::vector<CentreOff>& worst() const { return worst_; }

  /// For checkpoints (parallel/archive.hpp).
  template <class Archive>
  void transfer(Archive& a) {
    a(time_, lines_, worst_);
  }

 private:
  struct Line {
    double mass = 0;              // kg, at the start
    Vec<Dim> start;               // kg m, sum of m x there
    Vec<Dim> momentum;            // at the last look
    Vec<Dim> carried, uncertain;  // kg m, since the start
    double way = 0;               // kg m
  };
  /// Mass, mass times place (with that of what has left) and momentum of all bodies of a line.
  struct Sums {
    double mass = 0;
    Vec<Dim> place, momentum;
  };
  Sums sums_of(const Totals<Dim>& totals, std::size_t line) const;

  std::vector<bool> balanced_;
  std::vector<std::vector<std::size_t>> bodies_;  // of each line
  double time_ = 0;
  std::vector<Line> lines_;
  std::vector<CentreOff> worst_;
};

}  // namespace recoil
