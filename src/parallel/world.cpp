#include "parallel/world.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "core/error.hpp"
#include "parallel/pieces.hpp"
#include "parallel/post.hpp"
#include "parallel/traffic.hpp"

namespace recoil::parallel {

namespace {

bool started() {
  int yes = 0, ended = 0;
  MPI_Initialized(&yes);
  MPI_Finalized(&ended);
  return yes && !ended;
}

constexpr int tag_size = 1, tag_data = 2;

Traffic sent;  // MPI is called by one thread only

int int_count(std::size_t n) {
  require(n <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
          "a reduction of as many values as MPI counts");
  return static_cast<int>(n);
}

void send(const Bytes& bytes, int to) {
  for_each_piece(bytes.size(), [&](std::uint64_t first, int n) {
    MPI_Send(bytes.data() + first, n, MPI_BYTE, to, tag_data, MPI_COMM_WORLD);
  });
}

void receive(Bytes& bytes, int from) {
  for_each_piece(bytes.size(), [&](std::uint64_t first, int n) {
    MPI_Recv(bytes.data() + first, n, MPI_BYTE, from, tag_data, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
}

}  // namespace

Traffic traffic() { return sent; }

Traffic& counted_traffic() { return sent; }

Session::Session() {
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    throw EnvironmentError("MPI could not be started");
}

Session::~Session() {
  wait_until_taken();
  MPI_Finalize();
}

int World::rank() const {
  int r = 0;
  if (started()) MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

int World::size() const {
  int n = 1;
  if (started()) MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

double World::min(double local) const {
  double global = local;
  if (size() == 1) return global;
  ++sent.reductions;
  MPI_Allreduce(&local, &global, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
  return global;
}

double World::max(double local) const { return -min(-local); }

bool World::any(bool local) const { return max(local ? 1 : 0) > 0; }

void World::sum(std::span<std::int64_t> values) const {
  if (size() == 1) return;
  ++sent.reductions;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int_count(values.size()), MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
}

void World::max(std::span<double> values) const {
  if (size() == 1) return;
  ++sent.reductions;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int_count(values.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

std::vector<Bytes> World::gather(const Bytes& local) const {
  if (size() == 1) return {local};
  std::vector<Bytes> all;
  if (rank() != 0) {
    const std::uint64_t n = local.size();
    MPI_Send(&n, 1, MPI_UINT64_T, 0, tag_size, MPI_COMM_WORLD);
    send(local, 0);
    return all;
  }
  all.push_back(local);
  for (int r = 1; r < size(); ++r) {
    std::uint64_t n = 0;
    MPI_Recv(&n, 1, MPI_UINT64_T, r, tag_size, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    all.emplace_back(n);
    receive(all.back(), r);
  }
  return all;
}

void World::broadcast(Bytes& bytes) const {
  if (size() == 1) return;
  std::uint64_t n = bytes.size();
  MPI_Bcast(&n, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(n);
  for_each_piece(n, [&](std::uint64_t first, int count) {
    MPI_Bcast(bytes.data() + first, count, MPI_BYTE, 0, MPI_COMM_WORLD);
  });
}

std::vector<Message> World::exchange(const std::vector<Message>& out, const std::vector<int>& from) const {
  std::vector<Message> in(from.size());
  if (size() == 1) return in;
  if (!out.empty() || !from.empty()) ++sent.exchanges;
  std::vector<MPI_Request> requests;
  std::vector<std::uint64_t> out_size(out.size()), in_size(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    MPI_Irecv(&in_size[i], 1, MPI_UINT64_T, from[i], tag_size, MPI_COMM_WORLD, &requests.emplace_back());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int to = out[i].rank;  // clang 14 cannot use a structured binding in a lambda
    const Bytes& bytes = out[i].bytes;
    out_size[i] = bytes.size();
    ++sent.messages;
    sent.bytes += static_cast<std::int64_t>(bytes.size());
    MPI_Isend(&out_size[i], 1, MPI_UINT64_T, to, tag_size, MPI_COMM_WORLD, &requests.emplace_back());
    for_each_piece(bytes.size(), [&](std::uint64_t first, int n) {
      MPI_Isend(bytes.data() + first, n, MPI_BYTE, to, tag_data, MPI_COMM_WORLD, &requests.emplace_back());
    });
  }
  MPI_Waitall(static_cast<int>(from.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t i = 0; i < from.size(); ++i) {
    in[i].rank = from[i];
    in[i].bytes.resize(in_size[i]);
    for_each_piece(in_size[i], [&](std::uint64_t first, int n) {
      MPI_Irecv(in[i].bytes.data() + first, n, MPI_BYTE, from[i], tag_data, MPI_COMM_WORLD,
                &requests.emplace_back());
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return in;
}

void World::abort(int code) const {
  if (size() > 1) MPI_Abort(MPI_COMM_WORLD, code);
  std::exit(code);
}

void Unpacker::take(std::byte* to, std::size_t n) {
  require(static_cast<std::size_t>(end_ - at_) >= n, "a message is shorter than what is read from it");
  std::copy_n(at_, n, to);  // of none, `to` may be null
  at_ += n;
}

}  // namespace recoil::parallel
