#include "format/json_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace recoil {
namespace {

[[noreturn]] void refuse(const char* action, const std::filesystem::path& path, int error) {
  throw EnvironmentError(fmt::format("cannot {} '{}': {}", action, path.string(), std::strerror(error)));
}

/// Closes on leaving the scope; the explicit close() reports what the kernel held back until then.
class FileDescriptor {
 public:
  FileDescriptor(const std::filesystem::path& path, int flags) : FileDescriptor(path, flags, path) {}
  /// @param named what messages call it: the name that a temporary file will get.
  FileDescriptor(const std::filesystem::path& path, int flags, const std::filesystem::path& named)
      : path_(named), id_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (id_ < 0) refuse(named == path ? "open" : "write", path_, errno);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (id_ >= 0) ::close(id_);
  }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t done = ::write(id_, text.data(), text.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) refuse("write", path_, errno);
      text.remove_prefix(static_cast<std::size_t>(done));
    }
  }

  void take_room(std::uintmax_t bytes) {
    int error = EINTR;
    while (error == EINTR) error = ::posix_fallocate(id_, 0, static_cast<off_t>(bytes));
    // Some file systems cannot say.
    if (error != 0 && error != EINVAL && error != EOPNOTSUPP) refuse("write", path_, error);
  }

  void sync() {
    // Some file systems (pipes, FUSE mounts) have no fsync; the rename is still atomic there.
    if (::fsync(id_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
      refuse("sync", path_, errno);
  }

  void close() {
    const int id = id_;
    id_ = -1;
    if (::close(id) != 0) refuse("close", path_, errno);
  }

 private:
  std::filesystem::path path_;
  int id_;
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

void rename_over(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    refuse("replace", path, error);
  }
  FileDescriptor folder(folder_of(path), O_RDONLY | O_DIRECTORY);
  folder.sync();  // the new name itself must survive a power cut
}

}  // namespace

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (std::filesystem::is_directory(path)) return "";
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  return folder_of(path) / fmt::format(".{}.{}.tmp", path.filename().string(), ::getpid());
}

void take_room(const std::filesystem::path& path, std::uintmax_t bytes) {
  try {
    FileDescriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
    file.take_room(bytes);
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
  ::unlink(path.c_str());
}

void sync_and_rename(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  {
    FileDescriptor file(temporary, O_RDONLY);
    file.sync();
  }
  rename_over(temporary, path);
}

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  const auto temporary = temporary_name(path);
  try {
    FileDescriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC, path);
    file.write(text);
    file.sync();
    file.close();
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  rename_over(temporary, path);
}

}  // namespace recoil
