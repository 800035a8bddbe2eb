#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace recoil {

/// Working memory of one thread: a stack of arrays that is empty again when its Frame ends.
/// Grows while a run warms up; afterwards a step allocates nothing.
class Scratch {
 public:
  /// An uninitialised array of n values of T, aligned to 64 bytes, valid until the enclosing Frame ends.
  template <class T>
  T* take(std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = (n * sizeof(T) + 63) / 64 * 64;
    while (chunk_ < chunks_.size() && used_ + bytes > chunks_[chunk_].size) next_chunk();
    if (chunk_ == chunks_.size()) grow(bytes);
    auto* at = chunks_[chunk_].aligned() + used_;
    used_ += bytes;
    return reinterpret_cast<T*>(at);
  }

  template <class T>
  T* take_filled(std::size_t n, const T& value) {
    T* a = take<T>(n);
    for (std::size_t i = 0; i < n; ++i) a[i] = value;
    return a;
  }

  /// Gives back on destruction all that was taken during its life.
  class Frame {
   public:
    explicit Frame(Scratch& s) : s_(s), chunk_(s.chunk_), used_(s.used_) {}
    ~Frame() {
      s_.chunk_ = chunk_;
      s_.used_ = used_;
    }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

   private:
    Scratch& s_;
    std::size_t chunk_, used_;
  };

 private:
  struct Chunk {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size = 0;
    std::byte* aligned() const {
      const auto p = reinterpret_cast<std::uintptr_t>(memory.get());
      return memory.get() + ((p + 63) / 64 * 64 - p);
    }
  };

  void next_chunk() {
    ++chunk_;
    used_ = 0;
  }
  void grow(std::size_t bytes) {
    const std::size_t size = bytes > (std::size_t{4} << 20) ? bytes : (std::size_t{4} << 20);
    chunks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size + 64), size});
    used_ = 0;
  }

  std::vector<Chunk> chunks_;
  std::size_t chunk_ = 0, used_ = 0;
};

}  // namespace recoil
