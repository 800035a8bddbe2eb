#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gauge/totals.hpp"

namespace recoil {

/// Relative errors of the balances of one body, or of `total`.
struct Drift {
  std::string name;
  double mass = 0;      ///< of the mass
  double momentum = 0;  ///< of the largest sum of m |u| so far; the worst axis
  double energy = 0;    ///< of the largest total energy so far

  template <class Archive>
  void transfer(Archive& a) {
    a(name, mass, momentum, energy);
  }
};

/// Angular momentum about the origin of one body, or of `total` [kg m2/s].
struct Turning {
  std::string name;
  Vec<3> now;         ///< what it holds
  Vec<3> unbalanced;  ///< change since the start that contacts do not account for: errors, and what edges did
};

/// Compares what each deformable body holds with what it held at the start, what it has received over its
/// contacts and what has left through the edges of the domain; and the same for all of them together
/// (`total`), where only rigid bodies and the edges count. Momentum along r is not kept by an axisymmetric
/// body and does not count.
template <int Dim>
class BudgetWatch {
 public:
  /// @param names of all bodies; @param rigid which of them hold nothing; @param balanced the axes that
  /// count.
  BudgetWatch(std::vector<std::string> names, std::vector<bool> rigid, std::vector<bool> balanced);

  void begin(const Totals<Dim>& start);
  void look(const Totals<Dim>& totals);

  /// The largest errors at any look so far, `total` first, then each deformable body. A body that holds less
  /// than 1e-4 of the energy, or of the motion, of all bodies is measured with so much of theirs, and one
  /// slower than 0.1 m/s as if it moved so fast: what is but round-off is no error of its own. One that began
  /// empty is measured with the largest mass that it has held.
  const std::vector<Drift>& worst() const { return worst_; }
  /// Those of the last look.
  const std::vector<Drift>& now() const { return now_; }

  /// The largest sum, at any look so far, of the amounts by which the internal energy of each deformable body
  /// differs from that at the start [J].
  double converted() const { return converted_; }

  /// Angular momentum at the last look, in the same order. The scheme does not keep it exactly.
  const std::vector<Turning>& turning() const { return turning_; }

  /// For checkpoints (parallel/archive.hpp).
  template <class Archive>
  void transfer(Archive& a) {
    a(lines_, worst_, now_, converted_);
  }

 private:
  struct Sums {
    double mass = 0, energy = 0, speed = 0;
    Vec<Dim> momentum;
    Vec<3> angular_momentum;
  };
  struct Line {
    Sums start;
    double internal = 0;                                          // at the start
    double most_mass = 0, most_speed = 0, most_energy = 0;        // scales so far
    double mass_error = 0, momentum_error = 0, energy_error = 0;  // largest so far, absolute
  };
  Sums owed(const Totals<Dim>& totals, int body) const;
  void judge(std::size_t line, const Sums& sums);

  std::vector<bool> rigid_, balanced_;
  std::vector<int> body_;  // of each line; -1: total
  std::vector<Line> lines_;
  std::vector<Drift> worst_, now_;
  double converted_ = 0;
  std::vector<Turning> turning_;
};

}  // namespace recoil
