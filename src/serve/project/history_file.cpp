#include "serve/project/history_file.hpp"

#include <cerrno>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::serve {

HistoryFile::~HistoryFile() {
  close();
}

void HistoryFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void HistoryFile::open(std::uint64_t size) {
  close();
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor_ < 0) cannot_write(path_, system_reason());
  const auto end = ::lseek(descriptor_, 0, SEEK_END);
  size_ = size_before_ = size;
  if (end != static_cast<off_t>(size) && !cut()) cannot_write(path_, system_reason());
}

void HistoryFile::replace(std::string_view content) {
  write_file(path_, content);
  close();
  size_ = content.size();
  open(size_);
}

bool HistoryFile::cut() {
  has_rest_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0 || ::fsync(descriptor_) != 0;
  return !has_rest_;
}

void HistoryFile::append(std::string_view line) {
  if (descriptor_ < 0) open(size_);
  if (has_rest_ && !cut()) cannot_write(path_, system_reason());
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t written =
        ::pwrite(descriptor_, line.data() + done, line.size() - done, static_cast<off_t>(size_ + done));
    if (written < 0 && errno != EINTR) break;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  if (done < line.size() || ::fsync(descriptor_) != 0) {
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
