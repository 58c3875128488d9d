#include "shelfbeam/base/files/open_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/files/found_file.hpp"

namespace shelfbeam {

Descriptor open_unnamed(const std::filesystem::path& folder) {
  if (Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)); file.is_open())
    return file;
  // Some file systems have names only. If the process ends here, a hidden file remains.
  std::string name = folder / ".shelfbeam-XXXXXX";
  Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (file.is_open()) ::unlink(name.c_str());
  return file;
}

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
  if (!found.file.is_open() || static_cast<std::uint64_t>(found.state.st_size) != content.size())
    return false;
  std::array<char, 1 << 16> part{};
  while (!content.empty()) {
    const off_t at = found.state.st_size - static_cast<off_t>(content.size());
    const ssize_t got = ::pread(found.file.number(), part.data(), std::min(part.size(), content.size()), at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 || !content.starts_with(std::string_view(part.data(), static_cast<std::size_t>(got))))
      return false;
    content.remove_prefix(static_cast<std::size_t>(got));
  }
  return true;
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
