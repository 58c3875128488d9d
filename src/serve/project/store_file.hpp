#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "serve/project/regular_file.hpp"
#include "serve/text/json_value.hpp"

namespace shelfbeam::serve {

/// The largest store.json of a project, bytes.
inline constexpr std::uint64_t max_store_text = 5'000'000;

/// Throws InputError for a store that the program cannot use, e.g. of a newer format.
using StoreCheck = std::function<void(const Json&)>;

/// The file store.json of a project, which other programs may change at any time.
class StoreFile {
 public:
  StoreFile(std::filesystem::path path, StoreCheck check)
      : path_(std::move(path)), check_(std::move(check)) {}

  const std::filesystem::path& path() const { return path_; }

  /// As read_regular_file.
  std::optional<FileContent> read() const { return read_regular_file(path_, max_store_text); }

  /// Throws InputError unless the text is a JSON object of at most `max_store_text` bytes that passes the
  /// check. `value` is that of the text.
  void expect_valid(const std::string& text) const;
  void expect_valid(const std::string& text, const Json& value) const;

  /// Writes the text and returns the new stamp. If `old` is given and the file has another text, returns
  /// nothing, and the file stays. Throws OutputError.
  std::optional<FileStamp> put(const std::string& text, const std::string* old = nullptr) const;

  /// Gives what has the place of the file the first free name out of `store.json.outside-1`, ... A regular
  /// file has its own name as well until it is replaced. Throws OutputError.
  void set_aside() const;

 private:
  std::filesystem::path path_;
  StoreCheck check_;
};

}  // namespace shelfbeam::serve
