#include "parallel/chain.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "parallel/wait.hpp"

namespace recoil::parallel {

/// The exception that is reported.
struct Chain::Failures {
  std::mutex mutex;
  std::exception_ptr first;
  std::pair<int, int> place{std::numeric_limits<int>::max(), 0};  // phase, item

  /// @param end phases to be done: no more than up to the failed one.
  void note(int phase, int item, std::atomic<int>& end) {
    const std::lock_guard lock(mutex);
    if (std::pair(phase, item) > place) return;
    place = {phase, item};
    first = std::current_exception();
    end.store(phase + 1);
  }
};

Chain::Chain(Team& team, const std::vector<std::vector<int>>& beside, const std::vector<std::size_t>& cost,
             std::vector<std::uint8_t> urgent, bool shared)
    : team_(team),
      urgent_(std::move(urgent)),
      progress_(std::make_unique<std::atomic<int>[]>(beside.size())) {
  require(cost.size() == beside.size(), "a cost for each item");
  urgent_.resize(beside.size(), 0);
  first_beside_.push_back(0);
  for (const std::vector<int>& list : beside) {
    beside_.insert(beside_.end(), list.begin(), list.end());
    first_beside_.push_back(static_cast<int>(beside_.size()));
  }
  // An item is of the thread in whose part of all costs its middle lies.
  const auto threads = shared ? static_cast<std::size_t>(team.threads()) : std::size_t{1};
  const std::size_t all = std::accumulate(cost.begin(), cost.end(), std::size_t{0});
  first_of_.assign(threads + 1, items());
  first_of_[0] = 0;
  std::size_t before = 0, thread = 0;
  for (std::size_t i = 0; i < cost.size(); ++i) {
    while (thread + 1 < threads && (2 * before + cost[i]) * threads >= 2 * all * (thread + 1))
      first_of_[++thread] = static_cast<int>(i);
    before += cost[i];
  }
  cursor_.assign(threads * cursor_stride, 0);
}

bool Chain::claim(int item, int worker, Choice& found) {
  std::atomic<int>& own = progress_[static_cast<std::size_t>(item)];
  int at = own.load(std::memory_order_acquire);
  if ((at & 1) != 0 || at >= 2 * end_.load(std::memory_order_relaxed)) return false;
  const auto i = static_cast<std::size_t>(item);
  for (int k = first_beside_[i]; k < first_beside_[i + 1]; ++k) {
    const auto other = static_cast<std::size_t>(beside_[static_cast<std::size_t>(k)]);
    if (progress_[other].load(std::memory_order_acquire) < at) return false;
  }
  if (ready_ != nullptr && !(*ready_)(item, at / 2, worker)) return false;
  if (!own.compare_exchange_strong(at, at + 1, std::memory_order_acq_rel)) return false;
  found = {item, at / 2};
  return true;
}

bool Chain::find(int worker, Choice& found) {
  int& cursor = cursor_[static_cast<std::size_t>(worker) * cursor_stride];
  const int first = first_of(worker), count = first_of(worker + 1) - first;
  for (int item = first; item < first + count; ++item)
    if (urgent_[static_cast<std::size_t>(item)] != 0 && claim(item, worker, found)) return true;
  for (int k = 0; k < count; ++k) {
    const int at = cursor + k < count ? cursor + k : cursor + k - count;
    if (!claim(first + at, worker, found)) continue;
    cursor = at + 1 < count ? at + 1 : 0;
    return true;
  }
  for (int distance = 1; distance < items(); ++distance) {  // of others, the nearest ones first
    const int above = first + count - 1 + distance, below = first - distance;
    if (above >= items() && below < 0) break;
    if (above < items() && claim(above, worker, found)) return true;
    if (below >= 0 && claim(below, worker, found)) return true;
  }
  return false;
}

bool Chain::is_done() const {
  const int end = 2 * end_.load(std::memory_order_acquire);
  for (int i = 0; i < items(); ++i)
    if (progress_[static_cast<std::size_t>(i)].load(std::memory_order_acquire) < end) return false;
  return true;
}

void Chain::take_part(int worker, const Work& work, Failures& failures) {
  const auto look = time_before_sleep(threads());
  while (true) {
    const unsigned seen = done_.load();
    Choice next{};
    if (!find(worker, next)) {
      if (is_done()) return;
      if (ready_ == nullptr || worker != 0)
        wait_for_change(done_, seen, look, &asleep_);
      else if (look.count() > 0)
        rest_processor();  // and asks again: nobody could wake it
      else
        std::this_thread::yield();
      continue;
    }
    try {
      work(next.item, next.phase, worker);
    } catch (...) {
      failures.note(next.phase, next.item, end_);
    }
    progress_[static_cast<std::size_t>(next.item)].store(2 * next.phase + 2, std::memory_order_release);
    done_.fetch_add(1);
    if (asleep_.load() > 0) done_.notify_all();
  }
}

void Chain::run(int phases, const Work& work, const Ready& ready) {
  for (int i = 0; i < items(); ++i)
    progress_[static_cast<std::size_t>(i)].store(0, std::memory_order_relaxed);
  std::fill(cursor_.begin(), cursor_.end(), 0);
  end_.store(phases);
  ready_ = ready ? &ready : nullptr;
  Failures failures;
  if (threads() > 1)
    team_.run_each([&](int worker) { take_part(worker, work, failures); });
  else
    take_part(0, work, failures);
  ready_ = nullptr;
  if (failures.first) std::rethrow_exception(failures.first);
}

}  // namespace recoil::parallel
