#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// The lines of a mesh file as words, for checks that come before Assimp reads it.
class MeshLines {
 public:
  /// All three are kept by reference.
  MeshLines(std::string_view text, const std::filesystem::path& file, const std::string& where)
      : text_(text), file_(file), where_(where) {}

  /// The next line that is not blank.
  bool next();
  const std::vector<std::string_view>& words() const { return words_; }
  /// What follows the line.
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }

  /// Throws InputError unless the word of this number is a coordinate.
  void expect_coordinate(std::size_t word) const;
  /// InputError at the line.
  [[noreturn]] void fail(const std::string& problem) const;
  /// InputError about the whole file.
  [[noreturn]] void fail_file(const std::string& problem) const;

 private:
  std::string_view text_;
  const std::filesystem::path& file_;
  const std::string& where_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace shelfbeam
