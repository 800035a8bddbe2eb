#include "format/block_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "format/hdf5_handle.hpp"
#include "format/json_files.hpp"

namespace recoil {

namespace {

constexpr hsize_t largest_write = hsize_t{1} << 28;  // bytes; MPI counts bytes in an int
constexpr const char* format_name = "recoil blocks 1";

std::uint64_t hash_of_bytes(const parallel::Bytes& bytes) { return hash_of(bytes.data(), bytes.size()); }

parallel::Bytes bytes_of(const std::string& text) {
  parallel::Bytes bytes;
  parallel::pack(bytes, text.data(), text.size());
  return bytes;
}

/// A dataset of `total` numbers, of which this process writes those from `first` on.
template <class T>
void write_part(hid_t file, const char* name, hid_t type, std::size_t total, std::size_t first,
                const T* values, std::size_t count) {
  const hsize_t size = total;
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "make a space");
  const Hdf5Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                       "make a dataset");
  for (hsize_t done = 0; done < count;) {
    const hsize_t n = std::min<hsize_t>(count - done, largest_write / sizeof(T)), start = first + done;
    const Hdf5Handle memory(H5Screate_simple(1, &n, nullptr), H5Sclose, "make a space");
    Hdf5Handle::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &n, nullptr), "select");
    Hdf5Handle::check(H5Dwrite(set, type, memory, space, H5P_DEFAULT, values + done), "write the checkpoint");
    done += n;
  }
}

/// One process's part of the file.
struct Part {
  std::vector<std::int64_t> offset;  // of all blocks, and the end
  std::vector<std::uint64_t> hash;   // of own blocks
  parallel::Bytes bytes;             // of own blocks
};

Part part_of(long first, const std::vector<parallel::Bytes>& records, long blocks,
             const parallel::World& world) {
  Part part;
  std::vector<std::int64_t> size(static_cast<std::size_t>(blocks), 0);
  for (std::size_t k = 0; k < records.size(); ++k) {
    size[static_cast<std::size_t>(first) + k] = static_cast<std::int64_t>(records[k].size());
    part.hash.push_back(hash_of_bytes(records[k]));
    part.bytes.insert(part.bytes.end(), records[k].begin(), records[k].end());
  }
  world.sum(size);
  part.offset.assign(1, 0);
  for (const std::int64_t n : size) part.offset.push_back(part.offset.back() + n);
  return part;
}

void fill(hid_t file, const BlockFileHead& head, long first, const Part& part, const parallel::World& world) {
  const bool writes = world.rank() == 0;
  const auto whole = [&](const char* name, const parallel::Bytes& bytes) {
    std::array size{static_cast<std::int64_t>(writes ? bytes.size() : 0)};
    world.sum(size);
    write_part(file, name, H5T_NATIVE_UINT8, static_cast<std::size_t>(size[0]), 0,
               reinterpret_cast<const unsigned char*>(bytes.data()), writes ? bytes.size() : 0);
  };
  whole("format", bytes_of(format_name));
  whole("head", bytes_of(head.text));
  whole("whole", head.whole);
  const std::array<std::uint64_t, 2> sums{hash_of_bytes(bytes_of(head.text)), hash_of_bytes(head.whole)};
  write_part(file, "head_hash", H5T_NATIVE_UINT64, 2, 0, sums.data(), writes ? 2 : 0);
  write_part(file, "offset", H5T_NATIVE_INT64, part.offset.size(), 0, part.offset.data(),
             writes ? part.offset.size() : 0);
  const auto begin = static_cast<std::size_t>(first);
  write_part(file, "hash", H5T_NATIVE_UINT64, part.offset.size() - 1, begin, part.hash.data(),
             part.hash.size());
  write_part(file, "records", H5T_NATIVE_UINT8, static_cast<std::size_t>(part.offset.back()),
             static_cast<std::size_t>(part.offset[begin]),
             reinterpret_cast<const unsigned char*>(part.bytes.data()), part.bytes.size());
}

/// What the file needs beside the records, at most.
constexpr std::uintmax_t room_for_the_rest = 1 << 16;  // bytes

/// Takes the room of the file and gives it back: HDF5 1.10 cannot close a file that a full disk has cut
/// short, and its processes would wait for each other for ever. @throws EnvironmentError.
void look_for_room(const std::filesystem::path& temporary, const BlockFileHead& head, const Part& part) {
  const std::uintmax_t size = head.text.size() + head.whole.size() +
                              part.offset.size() * (sizeof part.offset[0] + sizeof part.hash[0]) +
                              static_cast<std::uintmax_t>(part.offset.back()) + room_for_the_rest;
  take_room(temporary, size);
}

/// All processes write into one file.
void write_together(const std::filesystem::path& temporary, const BlockFileHead& head, long first,
                    const Part& part, const parallel::World& world) {
  const QuietHdf5 quiet;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set the options of a file");
  Hdf5Handle::check(H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL), "write with several processes");
  Hdf5Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose,
                  "create the checkpoint");
  fill(file, head, first, part, world);
  file.close();
}

void write_alone(const std::filesystem::path& path, const BlockFileHead& head, long first, const Part& part,
                 const parallel::World& world) {
  const QuietHdf5 quiet;
  Hdf5Image file;
  fill(file, head, first, part, world);
  write_atomically(path, file.bytes());
}

/// f() on this process; the same error on all where it failed on any.
template <class F>
void together(const parallel::World& world, const char* what, F&& f) {
  std::string problem;
  try {
    f();
  } catch (const EnvironmentError& e) {
    problem = e.what();
  }
  if (!world.any(!problem.empty())) return;
  throw EnvironmentError(problem.empty() ? fmt::format("another process cannot {}", what) : problem);
}

[[noreturn]] void damaged(const std::filesystem::path& path, const std::string& what) {
  throw InputError(
      fmt::format("error: the checkpoint '{}' cannot be used: {}\n"
                  "   = help: `recoil resume DIR --from FILE` takes an earlier one",
                  path.string(), what));
}

/// Whether a dataset is stored as it was written: integers of the size of `type`, in one piece. A damaged
/// type may claim gigabytes for one number, which HDF5 would take as room to convert it.
bool as_written(hid_t set, hid_t type) {
  const Hdf5Handle stored(H5Dget_type(set), H5Tclose, "ask for a type");
  const Hdf5Handle how(H5Dget_create_plist(set), H5Pclose, "ask for the options of a dataset");
  return H5Tget_class(stored) == H5T_INTEGER && H5Tget_size(stored) == H5Tget_size(type) &&
         H5Pget_layout(how) == H5D_CONTIGUOUS;
}

template <class T>
std::vector<T> read_part(hid_t file, const char* name, hid_t type, const std::filesystem::path& path,
                         hsize_t first = 0, hsize_t count = H5S_ALL) {
  const hid_t id = H5Dopen2(file, name, H5P_DEFAULT);
  if (id < 0) damaged(path, fmt::format("it has no '{}': it is no checkpoint, or not whole", name));
  const Hdf5Handle set(id, H5Dclose, "open a dataset");
  if (!as_written(set, type)) damaged(path, fmt::format("its '{}' is of another type", name));
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "ask for a space");
  const auto total = static_cast<hsize_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0));
  if (count == H5S_ALL) count = total;
  if (first > total || count > total - first) damaged(path, fmt::format("its '{}' is too short", name));
  if (count >
      std::filesystem::file_size(path) / sizeof(T))  // what it claims may be more than there is memory
    damaged(path, fmt::format("its '{}' would be larger than the file", name));
  std::vector<T> values(count);
  if (count == 0) return values;
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "make a space");
  Hdf5Handle::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr), "select");
  if (H5Dread(set, type, memory, space, H5P_DEFAULT, values.data()) < 0)
    damaged(path, fmt::format("its '{}' cannot be read", name));
  return values;
}

parallel::Bytes read_bytes(hid_t file, const char* name, const std::filesystem::path& path, hsize_t first = 0,
                           hsize_t count = H5S_ALL) {
  return read_part<std::byte>(file, name, H5T_NATIVE_UINT8, path, first, count);
}

/// f() with what a refusal of HDF5 means where a file is read.
template <class F>
void reading(const std::filesystem::path& path, F&& f) {
  try {
    f();
  } catch (const EnvironmentError& e) {
    damaged(path, e.what());
  }
}

Hdf5Handle open_file(const std::filesystem::path& path) {
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0)
    damaged(path,
            std::filesystem::exists(path) ? "it is no HDF5 file, or was cut off" : "there is no such file");
  return {id, H5Fclose, "open a file"};
}

}  // namespace

void write_block_file(const std::filesystem::path& path, const BlockFileHead& head, long first,
                      const std::vector<parallel::Bytes>& records, long blocks,
                      const parallel::World& world) {
  const Part part = part_of(first, records, blocks, world);
  if (world.size() == 1) return write_alone(path, head, first, part, world);
  // The same name on all processes: rank 0's.
  auto name = bytes_of(temporary_name(path).string());
  world.broadcast(name);
  const std::filesystem::path temporary(std::string(reinterpret_cast<const char*>(name.data()), name.size()));
  const auto give_up = [&] {
    std::error_code ignored;
    if (world.rank() == 0) std::filesystem::remove(temporary, ignored);
  };
  try {
    together(world, "write the checkpoint", [&] {
      if (world.rank() == 0) look_for_room(temporary, head, part);
    });
    together(world, "write the checkpoint", [&] { write_together(temporary, head, first, part, world); });
    together(world, "write the checkpoint", [&] {
      if (world.rank() == 0) sync_and_rename(temporary, path);
    });
  } catch (...) {
    give_up();
    throw;
  }
}

BlockFile::BlockFile(std::filesystem::path path) : path_(std::move(path)) {
  reading(path_, [this] { read_head(); });
}

void BlockFile::read_head() {
  const QuietHdf5 quiet;
  const Hdf5Handle file = open_file(path_);
  if (read_bytes(file, "format", path_) != bytes_of(format_name)) damaged(path_, "it is of another version");
  const auto text = read_bytes(file, "head", path_);
  head_.text.assign(reinterpret_cast<const char*>(text.data()), text.size());
  head_.whole = read_bytes(file, "whole", path_);
  const auto sums = read_part<std::uint64_t>(file, "head_hash", H5T_NATIVE_UINT64, path_);
  if (sums.size() != 2 || sums[0] != hash_of_bytes(text) || sums[1] != hash_of_bytes(head_.whole))
    damaged(path_, "its checksum does not fit: it was changed or damaged");
  offset_ = read_part<std::int64_t>(file, "offset", H5T_NATIVE_INT64, path_);
  hash_ = read_part<std::uint64_t>(file, "hash", H5T_NATIVE_UINT64, path_);
  if (offset_.size() != hash_.size() + 1 || !std::is_sorted(offset_.begin(), offset_.end()) ||
      offset_[0] != 0)
    damaged(path_, "its table of blocks makes no sense");
}

parallel::Bytes BlockFile::record(long block) const {
  const QuietHdf5 quiet;
  const auto k = static_cast<std::size_t>(block);
  parallel::Bytes bytes;
  reading(path_, [&] {
    const Hdf5Handle file = open_file(path_);
    bytes = read_bytes(file, "records", path_, static_cast<hsize_t>(offset_[k]),
                       static_cast<hsize_t>(offset_[k + 1] - offset_[k]));
  });
  if (hash_of_bytes(bytes) != hash_[k])
    damaged(path_, fmt::format("the checksum of block {} does not fit: it was damaged", block));
  return bytes;
}

}  // namespace recoil
