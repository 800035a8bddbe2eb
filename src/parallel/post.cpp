#include "parallel/post.hpp"

#include <mpi.h>

#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "parallel/pieces.hpp"
#include "parallel/traffic.hpp"

namespace recoil::parallel {

namespace {

constexpr int tag_posted = 3;  // world.cpp has 1 and 2

/// A message on its way to another process: its bytes stay until it has been taken.
struct Leaving {
  Bytes bytes;
  std::vector<MPI_Request> requests{};
};

/// A message on its way from another process.
struct Arriving {
  Bytes bytes{};
  std::uint64_t before = 0;  // bytes of the pieces that are here
  MPI_Request request = MPI_REQUEST_NULL;
};

std::list<Leaving> leaving;
std::map<int, Arriving> arriving;  // by rank

bool is_taken(Leaving& one) {
  int done = 0;
  MPI_Testall(static_cast<int>(one.requests.size()), one.requests.data(), &done, MPI_STATUSES_IGNORE);
  return done != 0;
}

/// Begins to receive the next piece. @returns whether there is one.
bool begin_piece(Arriving& one, int rank) {
  int there = 0, n = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(rank, tag_posted, MPI_COMM_WORLD, &there, &message, &status);
  if (there == 0) return false;
  MPI_Get_count(&status, MPI_BYTE, &n);
  one.bytes.resize(one.before + static_cast<std::uint64_t>(n));
  MPI_Imrecv(one.bytes.data() + one.before, n, MPI_BYTE, &message, &one.request);
  return true;
}

}  // namespace

void post(int rank, Bytes&& bytes) {
  leaving.remove_if(is_taken);
  Traffic& sent = counted_traffic();
  ++sent.messages;
  sent.bytes += static_cast<std::int64_t>(bytes.size());
  Leaving& one = leaving.emplace_back(Leaving{std::move(bytes)});
  const auto send = [&](std::uint64_t first, int n) {
    MPI_Isend(one.bytes.data() + first, n, MPI_BYTE, rank, tag_posted, MPI_COMM_WORLD,
              &one.requests.emplace_back());
  };
  for_each_piece(one.bytes.size(), send);
  // Where the last piece is as long as one can be, an empty one says that it was the last.
  if (one.bytes.size() % longest_piece() == 0) send(one.bytes.size(), 0);
}

std::optional<Bytes> take_posted(int rank) {
  Arriving& one = arriving[rank];
  while (true) {
    if (one.request == MPI_REQUEST_NULL && !begin_piece(one, rank)) return {};
    int done = 0;
    MPI_Test(&one.request, &done, MPI_STATUS_IGNORE);
    if (done == 0) return {};
    const std::uint64_t piece = one.bytes.size() - one.before;
    one.before = one.bytes.size();
    if (piece == longest_piece()) continue;
    one.before = 0;
    return std::exchange(one.bytes, {});
  }
}

Bytes wait_for_posted(int rank) {
  while (true)
    if (std::optional<Bytes> bytes = take_posted(rank)) return std::move(*bytes);
}

void wait_until_taken() {
  for (Leaving& one : leaving)
    MPI_Waitall(static_cast<int>(one.requests.size()), one.requests.data(), MPI_STATUSES_IGNORE);
  leaving.clear();
}

}  // namespace recoil::parallel
