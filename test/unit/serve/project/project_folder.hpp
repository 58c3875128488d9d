#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/file.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam::serve {

/// A folder with a store.json of a few numbers.
class ProjectFolder {
 public:
  static constexpr std::string_view first_text = "{ // shop\n  \"a\": 1,\n  \"b\": [1, 2.0] // list\n}\n";

  explicit ProjectFolder(std::string_view text = first_text) { write_store(text); }

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }
  std::filesystem::path history() const { return folder_ / ".shelfbeam" / "history.jsonl"; }

  std::string store() const { return read_file(folder_ / "store.json"); }
  /// As another program writes it.
  void write_store(std::string_view text) const { folder_.write("store.json", text); }
  void write_history(std::string_view text) const { folder_.write(".shelfbeam/history.jsonl", text); }
  /// Of the history, with their ends.
  std::vector<std::string> lines() const {
    std::vector<std::string> lines(1);
    for (const char c : read_file(history())) {
      lines.back() += c;
      if (c == '\n') lines.emplace_back();
    }
    lines.pop_back();
    return lines;
  }

 private:
  test::TempFolder folder_;
};

}  // namespace shelfbeam::serve
