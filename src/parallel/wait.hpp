#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace recoil::parallel {

/// How long a thread looks before it sleeps: as long as most of what one thread does alone in a step. A step
/// has some tens of waits, and a thread that sleeps must be woken by the system. Not at all where there are
/// more threads than processors: what they wait for could not run.
inline std::chrono::microseconds time_before_sleep(int threads) {
  constexpr std::chrono::microseconds look{200};
  static const unsigned processors = std::thread::hardware_concurrency();
  return static_cast<unsigned>(threads) <= processors ? look : std::chrono::microseconds{0};
}

inline void rest_processor() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Waits until `value` is no longer `old`. It does not give its processor away while it looks: where other
/// programs run it would get it back milliseconds later.
/// @param asleep counts those that sleep here, if given: nobody need be woken where it is 0.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old, std::chrono::microseconds look,
                     std::atomic<int>* asleep = nullptr) {
  constexpr int looks_between = 64;  // readings of the clock
  const auto until = std::chrono::steady_clock::now() + look;
  do {
    for (int k = 0; k < looks_between; ++k) {
      if (value.load(std::memory_order_acquire) != old) return;
      rest_processor();
    }
  } while (std::chrono::steady_clock::now() < until);
  if (asleep != nullptr) asleep->fetch_add(1);
  value.wait(old);
  if (asleep != nullptr) asleep->fetch_sub(1);
}

}  // namespace recoil::parallel
