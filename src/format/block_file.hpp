#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "parallel/world.hpp"

namespace recoil {

/// What a file of blocks says about the whole: a text that describes it, and bytes that belong to no block.
struct BlockFileHead {
  std::string text;
  parallel::Bytes whole;
};

/// Writes one record of bytes for every block, with a checksum for each: HDF5, every process its own part.
/// The file appears under its name only when it is complete and on the disk. Collective.
/// @param head of rank 0. @param first number of this process's first block, counted over all processes in
/// their order. @param records of this process's blocks. @param blocks of all processes.
/// @throws EnvironmentError, on all processes alike.
void write_block_file(const std::filesystem::path& path, const BlockFileHead& head, long first,
                      const std::vector<parallel::Bytes>& records, long blocks, const parallel::World& world);

/// A file of blocks, open for reading by one process.
class BlockFile {
 public:
  /// @throws InputError where there is no such file, or it is damaged or something else.
  explicit BlockFile(std::filesystem::path path);
  const BlockFileHead& head() const { return head_; }
  long blocks() const { return static_cast<long>(hash_.size()); }
  /// The record of a block. @throws InputError where its checksum does not fit.
  parallel::Bytes record(long block) const;

 private:
  void read_head();

  std::filesystem::path path_;
  BlockFileHead head_;
  std::vector<std::int64_t> offset_;
  std::vector<std::uint64_t> hash_;
};

}  // namespace recoil
