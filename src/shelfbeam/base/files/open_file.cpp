#include "shelfbeam/base/files/open_file.hpp"

#include <algorithm>
#include <cerrno>

#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/files/found_file.hpp"

namespace shelfbeam {

std::optional<std::string> read_open(int descriptor, std::uint64_t size) {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (got == 0) break;  // it has become shorter
    if (got < 0 && errno != EINTR) return std::nullopt;
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

bool has_content(const std::filesystem::path& path, std::string_view content) {
  const FoundFile found = find_file_itself(path);
  return found.file.is_open() && static_cast<std::uint64_t>(found.state.st_size) == content.size() &&
         read_open(found.file.number(), content.size()) == content;
}

bool names(const std::filesystem::path& path, int descriptor) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

bool write_at(int descriptor, std::string_view bytes, std::uint64_t place) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno != EINTR) return false;
    const std::size_t done = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    bytes.remove_prefix(done);
    place += done;
  }
  return true;
}

}  // namespace shelfbeam
