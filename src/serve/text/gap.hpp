#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace shelfbeam::serve {

/// A gap is what lies between two tokens of a JSON text: blanks, ends of lines (LF, CR LF or CR) and
/// comments.
struct GapPart {
  enum class Kind { blanks, line_end, line_comment, block_comment };
  Kind kind;
  std::string_view text;  ///< of a line comment without the end of its line
};

/// The parts of a gap, in order. Other bytes, which a text may only have behind its value, count as blanks.
std::vector<GapPart> parts_of(std::string_view gap);

/// The position behind the gap that begins at `at`.
std::size_t gap_end(std::string_view text, std::size_t at);

/// The part of a gap that belongs to the line of the token before it: up to the first end of a line that is
/// not within a comment. The whole gap if it has none.
std::string_view first_line(std::string_view gap);

/// Whether the token behind the gap begins a line, perhaps after a comment.
bool has_line_end(std::string_view gap);

bool has_comment(std::string_view gap);

/// Whether text directly behind the gap would belong to its last comment.
bool ends_in_line_comment(std::string_view gap);

/// The blanks at the beginning of the last line.
std::string_view indentation(std::string_view gap);

/// The length of a gap up to the end of its last comment.
std::size_t comments_end(std::string_view gap);

/// The length of the blanks at the beginning, without ends of lines.
std::size_t leading_blanks(std::string_view gap);

/// Where the last line of the gap begins, together with the comments on the lines directly above: the
/// position of an end of a line. Precondition: the gap has one.
std::size_t own_lines(std::string_view gap);

}  // namespace shelfbeam::serve
