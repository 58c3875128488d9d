#include "serve/project/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve {

namespace {

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

std::int64_t ns_from(const timespec& time) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  return time.tv_sec * ns_per_s + time.tv_nsec;
}

FileStamp stamp_from(const struct stat& state) {
  return {state.st_ino, static_cast<std::uint64_t>(state.st_size), ns_from(state.st_mtim)};
}

[[noreturn]] void cannot_read(const std::filesystem::path& path) {
  throw InputError(path.string(), fmt::format("cannot be read ({})", system_reason()),
                   "check its permissions");
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat state = {};
  if (::lstat(path.c_str(), &state) != 0) return std::nullopt;
  return stamp_from(state);
}

std::optional<std::int64_t> change_time(const std::filesystem::path& path) {
  struct stat state = {};
  if (::lstat(path.c_str(), &state) != 0) return std::nullopt;
  return ns_from(state.st_ctim);
}

std::optional<FileContent> read_regular_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const OpenFile file(path);
  if (file.descriptor() < 0 && errno == ENOENT) return std::nullopt;
  if (file.descriptor() < 0 && errno == ELOOP)
    throw InputError(path.string(), "is a symbolic link", "replace it by the file that it names");
  struct stat state = {};
  if (file.descriptor() < 0 || ::fstat(file.descriptor(), &state) != 0) cannot_read(path);
  if (!S_ISREG(state.st_mode)) throw InputError(path.string(), "is not a regular file", "move it elsewhere");
  FileContent result{{}, stamp_from(state)};
  // One byte more shows whether the file has grown since.
  const std::uint64_t most = std::min(max_bytes, result.stamp.bytes) + 1;
  std::size_t size = 0;
  for (ssize_t got = 1; got > 0 && size < most && result.stamp.bytes <= max_bytes;) {
    result.content.resize(most);
    got = ::read(file.descriptor(), result.content.data() + size, most - size);
    if (got < 0) cannot_read(path);
    size += static_cast<std::size_t>(got);
  }
  result.content.resize(size);
  if (result.stamp.bytes > max_bytes || size > max_bytes)
    throw InputError(
        path.string(),
        fmt::format("has {} bytes; the maximum is {}",
                    grouped(std::max<std::uint64_t>(result.stamp.bytes, size)), grouped(max_bytes)),
        "check that it is the right file");
  return result;
}

}  // namespace shelfbeam::serve
