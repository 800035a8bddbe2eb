#pragma once

#include <cmath>

namespace recoil {

/// When something that happens every so often is to happen again: at the end of the first step at or after
/// each multiple of `every`; 0: at every step. The steps of a run do not change for it.
class Due {
 public:
  explicit Due(double every = 0) : every_(every) {}

  bool at(double time) const { return every_ <= 0 || time >= next_ * (1 - 1e-12); }
  /// It has happened at this time.
  void done(double time) {
    if (every_ > 0) next_ = (std::floor(time / every_ * (1 + 1e-12)) + 1) * every_;
  }

  /// Goes on where another one of the same kind was.
  void go_on(const Due& before) { next_ = before.next_; }
  /// For checkpoints (parallel/archive.hpp).
  template <class Archive>
  void transfer(Archive& a) {
    a(next_);
  }

 private:
  double every_, next_ = 0;
};

}  // namespace recoil
