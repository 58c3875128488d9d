#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "serve/project/history_file.hpp"
#include "serve/project/record.hpp"
#include "serve/project/timeline.hpp"

namespace shelfbeam::serve {

/// A history that has more than twice as many steps, or more bytes, is shortened to the newest steps.
struct HistoryLimits {
  std::size_t steps = 1000;
  std::uint64_t bytes = std::uint64_t{16} << 20;
};

struct HistoryTexts {
  std::string last;                        ///< behind the last record
  std::optional<std::string> before = {};  ///< before that record, unless it is the beginning
};

/// The history of a text in a file (docs/formats/history.md). Every record is on the disk before it counts.
class History {
 public:
  /// Reads the file, if there is one. A damaged record is cut off, together with those behind it; if it was
  /// not the last, `PATH.damaged` has the file as it was. Throws InputError for a history of another format,
  /// and OutputError.
  History(std::filesystem::path path, const HistoryLimits& limits);

  /// The texts that the records lead to; nothing if there is no history. They are kept until the first call.
  std::optional<HistoryTexts> take_texts() { return std::exchange(texts_, std::nullopt); }
  const Timeline& timeline() const { return timeline_; }

  /// Begins an empty history. Throws OutputError.
  void begin(const std::string& text, const std::string& time);
  /// Whether the file has not been removed or replaced.
  bool is_in_place() const { return file_.is_in_place(); }
  /// Writes the whole file anew. `text` is the present one. Throws OutputError.
  void restore(const std::string& text) { rewrite(0, text); }
  /// Writes a change or a move, which then counts with `accept` or not with `take_back`. Throws OutputError.
  void write(const Record& record);
  void take_back() { file_.take_back(); }
  /// `text` is the present one.
  void accept(const Record& record, const std::string& text);

 private:
  void read(std::string_view content);
  void replay(const Record& record);
  void shorten(const std::string& text);
  void rewrite(std::size_t outdated, const std::string& text);

  HistoryFile file_;
  HistoryLimits limits_;
  std::uint64_t most_bytes_;  ///< before the file is shortened again
  Timeline timeline_;
  std::optional<HistoryTexts> texts_;
};

}  // namespace shelfbeam::serve
