#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace recoil::parallel {

using Bytes = std::vector<std::byte>;

/// Starts MPI on construction and ends it on destruction. One per process, held by the application.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

/// One message between this process and another.
struct Message {
  int rank = 0;
  Bytes bytes;
};

/// All processes of the run. Without a Session: one process, rank 0.
/// Every reduction gives the same bits for any number of processes.
class World {
 public:
  int rank() const;
  int size() const;
  double min(double local) const;
  double max(double local) const;
  bool any(bool local) const;
  /// Element-wise sums, largest values, in place, over all processes.
  void sum(std::span<std::int64_t> values) const;
  void max(std::span<double> values) const;
  /// All processes' bytes in the order of their ranks, on rank 0; empty elsewhere.
  std::vector<Bytes> gather(const Bytes& local) const;
  /// Rank 0's bytes, everywhere.
  void broadcast(Bytes& bytes) const;
  /// Sends every message of `out`; returns one message from each rank in `from`, in that order.
  std::vector<Message> exchange(const std::vector<Message>& out, const std::vector<int>& from) const;
  /// Ends all processes at once with this exit code (an error on one of several).
  [[noreturn]] void abort(int code) const;
};

/// Appends plain values to bytes.
template <class T>
void pack(Bytes& bytes, const T* values, std::size_t n) {
  const auto* p = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), p, p + n * sizeof(T));
}
template <class T>
void pack(Bytes& bytes, const T& value) {
  pack(bytes, &value, 1);
}

/// Reads plain values back in the order in which they were packed.
class Unpacker {
 public:
  explicit Unpacker(const Bytes& bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}
  template <class T>
  void read(T* values, std::size_t n) {
    take(reinterpret_cast<std::byte*>(values), n * sizeof(T));
  }
  template <class T>
  T read() {
    T v{};
    read(&v, 1);
    return v;
  }
  bool empty() const { return at_ == end_; }

 private:
  void take(std::byte* to, std::size_t n);
  const std::byte* at_;
  const std::byte* end_;
};

}  // namespace recoil::parallel
