#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

// The bytes of a checkpoint file: a line, the identity as a record, a record for every state.

namespace shelfbeam::detail {

inline constexpr std::string_view checkpoint_line = "shelfbeam checkpoint 1\n";

/// The length of a record with so many bytes of content.
constexpr std::uint64_t record_size(std::uint64_t content) {
  return 3 * sizeof(std::uint64_t) + content;
}
constexpr std::uint64_t state_size(std::size_t values) {
  return record_size(2 * sizeof(std::uint32_t) + values * sizeof(double));
}

/// Writes records to a file, which it keeps open: whatever another process puts in its place, nobody else's
/// file is written to. Throws OutputError.
class RecordWriter {
 public:
  /// An existing, empty file. `name` stands for it in errors.
  RecordWriter(const std::filesystem::path& path, std::string name);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void line(std::string_view text) { write(text); }
  void record(std::string_view content);
  void state(std::uint32_t item, const CheckpointState& state);
  void flush();  ///< to the disk
  std::uint64_t written() const { return flushed_ + pending_.size(); }
  /// Forgets what comes after so many bytes.
  void cut(std::uint64_t size);
  /// Whether the file still has this name.
  bool is_at(const std::filesystem::path& path) const;

 private:
  void write(std::string_view bytes);
  void write_pending();
  [[noreturn]] void fail() const;

  std::string name_;
  int descriptor_;
  std::string pending_, content_;
  std::uint64_t flushed_ = 0;
};

/// Reads them back. What is cut off at the end is no record; anything else that does not fit its checksum
/// throws InputError.
class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& path);

  bool line(std::string_view expected);
  /// The content of the next record, until the next call; nothing at the end.
  std::optional<std::string_view> next();
  std::uint64_t good() const { return good_; }  ///< bytes up to the end of the last record
  [[noreturn]] void fail() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::size_t read(void* data, std::size_t size);

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0, good_ = 0;
  std::string content_;
};

}  // namespace shelfbeam::detail
