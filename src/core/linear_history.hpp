#pragma once

#include <cstddef>
#include <vector>

namespace recoil {

/// A quantity over time: straight lines between the times, constant before the first and after the last.
/// @tparam V number or vector.
template <class V>
struct LinearHistory {
  std::vector<double> times;  // s, growing
  std::vector<V> values{};

  V at(double time) const {
    if (time <= times.front()) return values.front();
    for (std::size_t k = 1; k < times.size(); ++k)
      if (time < times[k]) {
        const double part = (time - times[k - 1]) / (times[k] - times[k - 1]);
        return values[k - 1] + part * (values[k] - values[k - 1]);
      }
    return values.back();
  }

  /// The mean from one time to a later one, exact.
  V mean(double from, double to) const {
    if (!(to > from)) return at(from);
    V sum{};
    double begin = from;
    const auto go = [&](double end) {
      sum += (0.5 * (end - begin)) * (at(begin) + at(end));
      begin = end;
    };
    for (const double t : times)
      if (t > begin && t < to) go(t);
    go(to);
    return (1 / (to - from)) * sum;
  }
};

}  // namespace recoil
