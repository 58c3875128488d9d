#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shelfbeam/base/error.hpp"

#include "serve/text/splice.hpp"

namespace shelfbeam::serve {

/// The version of docs/formats/history.md.
inline constexpr int history_format = 1;

/// The text with which a history begins.
struct Beginning {
  std::string time;  ///< here and below: in UTC, "2026-11-27T12:30:32.123Z"
  std::string text;
};

/// A change of the text.
struct Change {
  std::string time, label;
  std::vector<std::string> paths;  ///< JSON pointers to what an edit changed
  bool joins = false;              ///< belongs to the step of the change before
  std::vector<Splice> splices;
  std::string before, after;  ///< content hashes of the texts

  bool operator==(const Change&) const = default;
};

/// Undo and redo: afterwards, the first `position` steps are applied.
struct Move {
  std::string time;
  std::size_t position = 0;
  std::string before, after;
};

/// An entry of the history of a project.
using Record = std::variant<Beginning, Change, Move>;

/// The record as one line of JSON, with its end.
std::string line_of(const Record& record);

/// The history is of another format version.
class OtherHistoryFormat : public InputError {
 public:
  explicit OtherHistoryFormat(const InputError& error) : InputError(error) {}
};

/// Reads a line without its end. Throws OtherHistoryFormat, and InputError if it is not a record; both name
/// the line as `name`.
Record read_record(std::string_view line, const std::string& name);

std::string utc_text(std::chrono::system_clock::time_point time);

}  // namespace shelfbeam::serve
