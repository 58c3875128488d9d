#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

#include "shelfbeam/base/files/descriptor.hpp"
#include "shelfbeam/base/files/open_file.hpp"

namespace shelfbeam::serve {

/// A file that grows by whole lines. One process at a time writes it. All functions throw OutputError if the
/// file cannot be written; it then has the lines that it had before.
class HistoryFile {
 public:
  explicit HistoryFile(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Whether the path still names the file that was opened.
  bool is_in_place() const { return names(path_, file_.number()); }

  /// Opens the existing file, and cuts off what follows its first `size` bytes.
  void open(std::uint64_t size);
  /// Replaces or creates the file; there is no moment without either.
  void replace(std::string_view content);
  /// Adds a line. It is on the disk when this returns.
  void append(std::string_view line);
  /// Cuts off the line that was added last.
  void take_back();

 private:
  bool cut();

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0, size_before_ = 0;  ///< now, and before the last line
  bool has_rest_ = false;                     ///< more bytes that could not be cut off
};

}  // namespace shelfbeam::serve
