#pragma once

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

// The bytes of a checkpoint file: a line, a record with the identity, and a record per saved state.

namespace shelfbeam::detail {

/// The size of a record with `content` bytes of content.
constexpr std::uint64_t record_size(std::uint64_t content) {
  return 3 * sizeof(std::uint64_t) + content;
}
constexpr std::uint64_t state_size(std::size_t values) {
  return record_size(2 * sizeof(std::uint32_t) + values * sizeof(double));
}

// Precedes the content of a record: its length, its hash, and a hash of both and the position in the file.
struct RecordHead {
  std::uint64_t length, content_hash, own_hash;
};

inline std::uint64_t hash_of_head(std::uint64_t length, std::uint64_t content_hash, std::uint64_t place) {
  const std::array<std::uint64_t, 3> values{length, content_hash, place};
  return hash64({reinterpret_cast<const char*>(values.data()), sizeof values});
}

/// What to do about a corrupt file.
struct RecordRemedy {
  const char* text = "delete it, or start again without resuming";
  Setting setting = Setting::resumption;
};

/// Reads records. A truncated record at the end is ignored; any other mismatch of a checksum throws
/// InputError.
class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& path, RecordRemedy remedy = {})
      : name_(path.string()),
        remedy_(remedy),
        size_(input_size(path)),
        file_(std::fopen(path.c_str(), "rb")) {
    if (!file_)
      throw InputError(name_, fmt::format("cannot be read ({})", system_reason()), "check its permissions");
  }

  bool line(std::string_view expected) {
    std::string found(expected.size(), '\0');
    if (read(found.data(), found.size()) != found.size() || found != expected) return false;
    valid_size_ = expected.size();
    return true;
  }
  /// The content of the next record, valid until the next call; nothing at the end.
  std::optional<std::string_view> next() {
    RecordHead head;
    if (size_ - valid_size_ < sizeof head) return std::nullopt;
    if (read(&head, sizeof head) != sizeof head ||
        head.own_hash != hash_of_head(head.length, head.content_hash, valid_size_))
      fail();
    const std::uint64_t left = size_ - valid_size_ - sizeof head;
    if (left < head.length) return std::nullopt;
    content_.resize(head.length);
    if (read(content_.data(), content_.size()) != content_.size() || hash64(content_) != head.content_hash)
      fail();
    valid_size_ += record_size(head.length);
    return content_;
  }
  std::uint64_t valid_size() const { return valid_size_; }  ///< bytes up to the end of the last record
  [[noreturn]] void fail() const {
    throw InputError(name_, fmt::format("is corrupt at byte {}", valid_size_), remedy_.text, remedy_.setting);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::size_t read(void* data, std::size_t size) { return std::fread(data, 1, size, file_.get()); }

  std::string name_;
  RecordRemedy remedy_;
  std::uint64_t size_, valid_size_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
  std::string content_;
};

/// Reads the line and the identity with which a file begins. Throws InputError for a file of another version
/// or of another run.
inline void expect_head(RecordReader& file, std::string_view line, const CheckpointIdentity& identity,
                        const std::filesystem::path& path) {
  if (!file.line(line))
    throw InputError(path.string(), "is not a checkpoint of this program version",
                     "delete it, or start again without resuming", Setting::resumption);
  const auto first = file.next();
  if (!first) file.fail();
  expect_identity(identity, *first, path);
  if (*first != to_text(identity)) file.fail();
}

/// Writes records to a file that stays open, so that it never writes to a file with which another process
/// replaced it. Throws OutputError.
class RecordWriter {
 public:
  /// `path` must be an existing, empty file. Errors name it as `name`.
  RecordWriter(const std::filesystem::path& path, std::string name)
      : name_(std::move(name)), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  ~RecordWriter() { ::close(descriptor_); }
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void line(std::string_view text) { write(text); }
  void record(std::string_view content) {
    RecordHead head{content.size(), hash64(content), 0};
    head.own_hash = hash_of_head(head.length, head.content_hash, written());
    write({reinterpret_cast<const char*>(&head), sizeof head});
    write(content);
  }
  void state(std::uint32_t item, const CheckpointState& state) {
    const std::array<std::uint32_t, 2> numbers{item, state.batches};
    content_.assign(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    content_.append(reinterpret_cast<const char*>(state.values.data()), state.values.size_bytes());
    record(content_);
  }
  /// Flushes all records to disk.
  void flush() {
    write_pending();
    if (::fdatasync(descriptor_) != 0) fail();
  }
  std::uint64_t written() const { return flushed_ + pending_.size(); }
  /// Truncates the file to `size` bytes.
  void truncate(std::uint64_t size) {
    pending_.clear();
    flushed_ = size;
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail();
  }
  /// Whether `path` still refers to this file.
  bool is_at(const std::filesystem::path& path) const {
    struct stat there = {}, own = {};
    return ::stat(path.c_str(), &there) == 0 && ::fstat(descriptor_, &own) == 0 &&
           there.st_dev == own.st_dev && there.st_ino == own.st_ino;
  }

 private:
  void write(std::string_view bytes) {
    constexpr std::size_t max_pending = 1 << 20;
    pending_ += bytes;
    if (pending_.size() >= max_pending) write_pending();
  }
  void write_pending() {
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
  [[noreturn]] void fail() const { cannot_write(name_, system_reason()); }

  std::string name_;
  int descriptor_;
  std::string pending_, content_;
  std::uint64_t flushed_ = 0;
};

}  // namespace shelfbeam::detail
