#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace recoil {

/// Wall time spent in each of a fixed list of parts, an enum class Part with a member `count`.
template <class Part>
class Timers {
 public:
  /// Adds the time of its life to one part.
  class Span {
   public:
    Span(Timers& t, Part part) : t_(t), part_(part), start_(std::chrono::steady_clock::now()) {}
    ~Span() {
      const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start_;
      t_.seconds_[static_cast<std::size_t>(part_)] += d.count();
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    Timers& t_;
    Part part_;
    std::chrono::steady_clock::time_point start_;
  };

  void add(Part part, double seconds) { seconds_[static_cast<std::size_t>(part)] += seconds; }
  double seconds(Part part) const { return seconds_[static_cast<std::size_t>(part)]; }
  double total() const {
    double sum = 0;
    for (const double s : seconds_) sum += s;
    return sum;
  }

 private:
  std::array<double, static_cast<std::size_t>(Part::count)> seconds_{};
};

}  // namespace recoil
