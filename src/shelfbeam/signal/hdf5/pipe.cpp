#include "shelfbeam/signal/hdf5/pipe.hpp"

#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace shelfbeam::detail {

namespace {

constexpr std::size_t buffer_size = 1 << 16;

// Calls read or write until all bytes have gone through.
template <class Transfer, class Byte>
void all(Transfer transfer, Byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t done = transfer(data, size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw BrokenPipe(std::strerror(errno));
    if (done == 0) throw BrokenPipe("it ends early");
    data += done;
    size -= static_cast<std::size_t>(done);
  }
}

}  // namespace

void PipeWriter::bytes(const void* data, std::size_t size) {
  const char* const from = static_cast<const char*>(data);
  if (buffer_.size() + size > buffer_size) flush();
  if (size > buffer_size)
    all([this](const char* at, std::size_t rest) { return ::write(descriptor_, at, rest); }, from, size);
  else
    buffer_.insert(buffer_.end(), from, from + size);
}

void PipeWriter::flush() {
  all([this](const char* at, std::size_t rest) { return ::write(descriptor_, at, rest); }, buffer_.data(),
      buffer_.size());
  buffer_.clear();
}

void PipeReader::bytes(void* data, std::size_t size) {
  all([this](char* at, std::size_t rest) { return ::read(descriptor_, at, rest); }, static_cast<char*>(data),
      size);
}

}  // namespace shelfbeam::detail
