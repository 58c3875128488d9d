#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// The known word nearest to `word` by edit distance; empty when no word is near enough for a typing error,
/// or if `word` is too long for one.
std::string nearest(std::string_view word, std::span<const std::string_view> known);

/// "did you mean 'x'?" when a known word is near, else "known: a, b, c".
std::string suggest(std::string_view word, std::span<const std::string_view> known);

std::string join(std::span<const std::string_view> words, std::string_view separator);

/// Shell-style match: '*' matches any run of characters, '?' matches one character.
bool matches_glob(std::string_view text, std::string_view pattern);

/// The indices of the ids that match a pattern, ascending.
std::vector<std::uint32_t> matching_ids(std::string_view pattern, std::span<const std::string_view> ids);

/// Splits at `separator` (empty fields kept) and trims blanks around each field.
std::vector<std::string_view> split(std::string_view line, char separator);

std::string_view trim(std::string_view text);

/// Converts ASCII letters only.
std::string lower_case(std::string_view text);

/// 12345 -> "12,345".
std::string grouped(std::uint64_t count);

/// "1 label", "2 labels", "12,345 labels".
std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural = {});

struct Character {
  std::uint32_t code;  ///< code point, or a byte that is not UTF-8
  std::size_t bytes;
  bool is_printable;  ///< as in `printable`
  bool is_utf8;
};

/// The character that begins at byte `i`.
Character character_at(std::string_view text, std::size_t i);

/// Whether the bytes are well-formed UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

inline constexpr auto save_as_utf8 = "save it as UTF-8",
                      save_table_as_utf8 = "save it as UTF-8 (in Excel: CSV UTF-8)";

/// The text of a file without a UTF-8 byte order mark. Every reader of text calls this first, `read_text` for
/// it. Throws InputError, with `name` as the location, if the text is UTF-16 or UTF-32, which a mark or the
/// null bytes of its first characters show.
std::string_view without_mark(std::string_view text, const std::string& name,
                              const char* remedy = save_as_utf8);

/// Removes the first line of `text` and returns it without its end, which is LF, CR LF or CR.
std::string_view take_line(std::string_view& text);

/// `text` for a terminal: characters that control the terminal, change the direction of writing or are
/// invisible are escaped ("\\n", "\\x1b", "\\u202e"), as are bytes that are not UTF-8.
std::string printable(std::string_view text);

/// The first character of `text` that `printable` escapes, escaped; empty if there is none.
std::string unprintable_character(std::string_view text);

/// A text of more than `most` bytes is cut in its middle, where "..." replaces the rest.
std::string shortened(std::string_view text, std::size_t most);

/// A value from a file in a message: 'value', shortened if it is long.
std::string in_quotes(std::string_view value);

/// The whole of `text` as a number ("nan" and "inf" count as numbers); nothing if it is not a number or lies
/// outside the range of a double. Independent of the locale.
std::optional<double> to_number(std::string_view text);

/// The whole of `text` as a whole number without sign and leading zeros; nothing for other texts and above
/// `most`.
std::optional<std::size_t> to_whole_number(std::string_view text, std::size_t most);

/// RFC 4648, with padding.
std::string to_base64(std::string_view bytes);

/// The largest signal, cost or requirement of a table. Its square, and sums of millions of squares, are far
/// from the limits of single precision.
inline constexpr double max_amount = 1e18;

/// The problem with a signal, cost or requirement ("is NaN"); empty if the value is 0 to `max_amount`.
std::string_view amount_problem(double value);

}  // namespace shelfbeam
