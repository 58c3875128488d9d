#include "shelfbeam/signal/detail/checkpoint_records.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::detail {

namespace {

// Before the content of a record: its length, its hash, and a hash of both and the place in the file.
struct RecordHead {
  std::uint64_t length, content_hash, own_hash;
};

std::uint64_t hash_of_head(std::uint64_t length, std::uint64_t content_hash, std::uint64_t place) {
  const std::array<std::uint64_t, 3> values{length, content_hash, place};
  return hash64({reinterpret_cast<const char*>(values.data()), sizeof values});
}

}  // namespace

RecordWriter::RecordWriter(const std::filesystem::path& path, const char* mode, std::string name)
    : name_(std::move(name)), file_(std::fopen(path.c_str(), mode)) {
  if (!file_) fail();
  std::fseek(file_.get(), 0, SEEK_END);
  written_ = static_cast<std::uint64_t>(std::ftell(file_.get()));
}

void RecordWriter::fail() const {
  throw InputError(name_, fmt::format("cannot be written ({})", std::generic_category().message(errno)),
                   "check that the disk has room and the folder may be written to");
}

void RecordWriter::write(const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, file_.get()) != size) fail();
  written_ += size;
}

void RecordWriter::line(std::string_view text) {
  write(text.data(), text.size());
}

void RecordWriter::record(std::string_view content) {
  RecordHead head{content.size(), hash64(content), 0};
  head.own_hash = hash_of_head(head.length, head.content_hash, written_);
  write(&head, sizeof head);
  write(content.data(), content.size());
}

void RecordWriter::state(std::uint32_t item, const CheckpointState& state) {
  const std::array<std::uint32_t, 2> numbers{item, state.batches};
  buffer_.assign(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  buffer_.append(reinterpret_cast<const char*>(state.values.data()), state.values.size_bytes());
  record(buffer_);
}

void RecordWriter::close() {
  if (std::fflush(file_.get()) != 0 || ::fdatasync(::fileno(file_.get())) != 0) fail();
  if (std::fclose(file_.release()) != 0) fail();
}

RecordReader::RecordReader(const std::filesystem::path& path)
    : name_(path.string()), file_(std::fopen(path.c_str(), "rb")) {
  if (!file_)
    throw InputError(name_, fmt::format("cannot be read ({})", std::generic_category().message(errno)),
                     "check its permissions");
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
