#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/scratch.hpp"

namespace recoil::parallel {

/// The threads of this process, each with its working memory.
class Team {
 public:
  /// @param threads at least 1; this thread counts.
  explicit Team(int threads = 1);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const;
  Scratch& scratch(int worker);

  /// Calls task(item, worker) once for each item in [0, items), the first ones first. A thread takes the same
  /// items in every call with as many, as long as none is late: what it worked on is still near its
  /// processor. An exception of the lowest item that failed is thrown again here.
  void run(int items, const std::function<void(int, int)>& task);
  /// Calls task(worker) once for each thread; one that is late may find that another has done its call as
  /// well.
  void run_each(const std::function<void(int)>& task);

 private:
  struct Pool;
  void share(int items, const std::function<void(int, int)>& task, bool together);
  std::unique_ptr<Pool> pool_;
};

/// The one place where work is shared between threads: f(block, scratch) for every block of the list.
template <class F>
void for_each_block(Team& team, const std::vector<int>& blocks, F&& f) {
  team.run(static_cast<int>(blocks.size()), [&](int item, int worker) {
    Scratch& scratch = team.scratch(worker);
    const Scratch::Frame frame(scratch);
    f(blocks[item], scratch);
  });
}

}  // namespace recoil::parallel
