#include "parallel/team.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "parallel/wait.hpp"

namespace recoil::parallel {

namespace {

/// How many of the items of one thread are left: it takes them from the front, others from the back.
class alignas(64) Share {
 public:
  void fill(int count) {
    left_.store(packed(0, static_cast<std::uint32_t>(count)), std::memory_order_relaxed);
  }
  /// The next one, or below 0.
  int take(bool own) {
    std::uint64_t left = left_.load();
    while (true) {
      const auto first = static_cast<std::uint32_t>(left >> 32U), last = static_cast<std::uint32_t>(left);
      if (first >= last) return -1;
      const std::uint64_t after = own ? packed(first + 1, last) : packed(first, last - 1);
      if (left_.compare_exchange_weak(left, after)) return static_cast<int>(own ? first : last - 1);
    }
  }

 private:
  static std::uint64_t packed(std::uint32_t first, std::uint32_t last) {
    return static_cast<std::uint64_t>(first) << 32U | last;
  }
  std::atomic<std::uint64_t> left_{0};
};

}  // namespace

struct Team::Pool {
  std::chrono::microseconds look{0};  // before a thread sleeps
  std::vector<std::unique_ptr<Scratch>> scratch;
  std::vector<std::jthread> workers;
  const std::function<void(int, int)>* task = nullptr;
  std::vector<Share> shares;  // by thread; item k of thread w is w + k * stride
  int stride = 1;
  std::atomic<int> busy{0};
  std::atomic<unsigned> round{0};
  std::atomic<bool> stop{false};
  std::mutex failure_mutex;
  std::exception_ptr failure;
  int failed_item = std::numeric_limits<int>::max();

  void work(int worker) {
    const auto threads = static_cast<int>(shares.size());
    for (int k = 0; k < threads; ++k) {
      const int owner = (worker + k) % threads;
      Share& share = shares[static_cast<std::size_t>(owner)];
      for (int n = share.take(k == 0); n >= 0; n = share.take(k == 0)) run(owner + n * stride, worker);
    }
  }

  void run(int item, int worker) {
    try {
      (*task)(item, worker);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (item < failed_item) {
        failed_item = item;
        failure = std::current_exception();
      }
    }
  }

  void serve(int worker) {
    unsigned seen = 0;
    while (true) {
      wait_for_change(round, seen, look);
      seen = round.load();
      if (stop) return;
      work(worker);
      if (busy.fetch_sub(1) == 1) busy.notify_one();
    }
  }
};

Team::Team(int threads) : pool_(std::make_unique<Pool>()) {
  require(threads >= 1, "a team has at least one thread");
  pool_->look = time_before_sleep(threads);
  pool_->shares = std::vector<Share>(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) pool_->scratch.push_back(std::make_unique<Scratch>());
  for (int i = 1; i < threads; ++i) pool_->workers.emplace_back([this, i] { pool_->serve(i); });
}

Team::~Team() {
  pool_->stop = true;
  pool_->round.fetch_add(1);
  pool_->round.notify_all();
}

int Team::threads() const { return static_cast<int>(pool_->scratch.size()); }

Scratch& Team::scratch(int worker) { return *pool_->scratch[worker]; }

void Team::run(int items, const std::function<void(int, int)>& task) {
  // Waking the others costs more than a few blocks of work.
  share(items, task, threads() > 1 && items >= 4);
}

void Team::run_each(const std::function<void(int)>& task) {
  share(
      threads(), [&](int /*item*/, int worker) { task(worker); }, threads() > 1);
}

void Team::share(int items, const std::function<void(int, int)>& task, bool together) {
  Pool& p = *pool_;
  p.task = &task;
  p.stride = together ? threads() : 1;
  for (int thread = 0; thread < threads(); ++thread)
    p.shares[static_cast<std::size_t>(thread)].fill(
        thread < p.stride ? (std::max(items - thread, 0) + p.stride - 1) / p.stride : 0);
  if (together) {
    p.busy = threads() - 1;
    p.round.fetch_add(1);
    p.round.notify_all();
  }
  p.work(0);
  if (together)
    for (int left = p.busy.load(); left > 0; left = p.busy.load()) wait_for_change(p.busy, left, p.look);
  if (p.failure) {
    const auto failure = std::exchange(p.failure, nullptr);
    p.failed_item = std::numeric_limits<int>::max();
    std::rethrow_exception(failure);
  }
}

}  // namespace recoil::parallel
