#include "serve/project/history_file.hpp"

#include <cerrno>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "shelfbeam/base/file.hpp"

#include "serve/project/regular_file.hpp"

namespace shelfbeam::serve {

void HistoryFile::open(std::uint64_t size) {
  file_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!file_.is_open() && errno == EACCES) {
    // Another user of the folder wrote it, and only lets others read it: a copy takes its place.
    auto found = read_regular_file(path_, max_text_file);
    if (found && found->content.size() >= size) return replace(found->content.substr(0, size));
    errno = EACCES;
  }
  if (!file_.is_open()) cannot_write(path_, system_reason());
  const auto end = ::lseek(file_.number(), 0, SEEK_END);
  size_ = size_before_ = size;
  if (end != static_cast<off_t>(size) && !cut()) cannot_write(path_, system_reason());
}

void HistoryFile::replace(std::string_view content) {
  write_file(path_, content);
  open(content.size());
}

bool HistoryFile::cut() {
  has_rest_ = ::ftruncate(file_.number(), static_cast<off_t>(size_)) != 0 || ::fsync(file_.number()) != 0;
  return !has_rest_;
}

void HistoryFile::append(std::string_view line) {
  if (has_rest_ && !cut()) cannot_write(path_, system_reason());
  if (!write_at(file_.number(), line, size_) || ::fsync(file_.number()) != 0) {
    const std::string reason = system_reason();
    cut();
    cannot_write(path_, reason);
  }
  size_before_ = size_;
  size_ += line.size();
}

void HistoryFile::take_back() {
  size_ = size_before_;
  cut();
}

}  // namespace shelfbeam::serve
