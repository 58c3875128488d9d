#include "shelfbeam/signal/checkpoint/checkpoint_records.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::size_t most_pending = 1 << 20;

// Before the content of a record: its length, its hash, and a hash of both and the place in the file.
struct RecordHead {
  std::uint64_t length, content_hash, own_hash;
};

std::uint64_t hash_of_head(std::uint64_t length, std::uint64_t content_hash, std::uint64_t place) {
  const std::array<std::uint64_t, 3> values{length, content_hash, place};
  return hash64({reinterpret_cast<const char*>(values.data()), sizeof values});
}

}  // namespace

RecordWriter::RecordWriter(const std::filesystem::path& path, std::string name)
    : name_(std::move(name)), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail();
}

RecordWriter::~RecordWriter() {
  ::close(descriptor_);
}

void RecordWriter::fail() const {
  cannot_write(name_, system_reason());
}

void RecordWriter::write(std::string_view bytes) {
  pending_ += bytes;
  if (pending_.size() >= most_pending) write_pending();
}

void RecordWriter::write_pending() {
  for (std::size_t done = 0; done < pending_.size();) {
    const ssize_t count = ::pwrite(descriptor_, pending_.data() + done, pending_.size() - done,
                                   static_cast<off_t>(flushed_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail();
    done += static_cast<std::size_t>(count);
  }
  flushed_ += pending_.size();
  pending_.clear();
}

void RecordWriter::record(std::string_view content) {
  RecordHead head{content.size(), hash64(content), 0};
  head.own_hash = hash_of_head(head.length, head.content_hash, written());
  write({reinterpret_cast<const char*>(&head), sizeof head});
  write(content);
}

void RecordWriter::state(std::uint32_t item, const CheckpointState& state) {
  const std::array<std::uint32_t, 2> numbers{item, state.batches};
  content_.assign(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  content_.append(reinterpret_cast<const char*>(state.values.data()), state.values.size_bytes());
  record(content_);
}

void RecordWriter::flush() {
  write_pending();
  if (::fdatasync(descriptor_) != 0) fail();
}

void RecordWriter::cut(std::uint64_t size) {
  pending_.clear();
  flushed_ = size;
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail();
}

bool RecordWriter::is_at(const std::filesystem::path& path) const {
  struct stat there = {}, own = {};
  return ::stat(path.c_str(), &there) == 0 && ::fstat(descriptor_, &own) == 0 && there.st_dev == own.st_dev &&
         there.st_ino == own.st_ino;
}

RecordReader::RecordReader(const std::filesystem::path& path)
    : name_(path.string()), file_(std::fopen(path.c_str(), "rb")) {
  if (!file_)
    throw InputError(name_, fmt::format("cannot be read ({})", system_reason()), "check its permissions");
  size_ = std::filesystem::file_size(path);
}

void RecordReader::fail() const {
  throw InputError(name_, fmt::format("is damaged at byte {}", good_),
                   "delete it, or run without '--resume', to begin anew");
}

std::size_t RecordReader::read(void* data, std::size_t size) {
  return std::fread(data, 1, size, file_.get());
}

bool RecordReader::line(std::string_view expected) {
  std::string found(expected.size(), '\0');
  if (read(found.data(), found.size()) != found.size() || found != expected) return false;
  good_ = expected.size();
  return true;
}

std::optional<std::string_view> RecordReader::next() {
  RecordHead head;
  if (size_ - good_ < sizeof head) return std::nullopt;
  if (read(&head, sizeof head) != sizeof head ||
      head.own_hash != hash_of_head(head.length, head.content_hash, good_))
    fail();
  const std::uint64_t left = size_ - good_ - sizeof head;
  if (left < head.length) return std::nullopt;
  content_.resize(head.length);
  if (read(content_.data(), content_.size()) != content_.size() || hash64(content_) != head.content_hash)
    fail();
  good_ += record_size(head.length);
  return content_;
}

}  // namespace shelfbeam::detail
