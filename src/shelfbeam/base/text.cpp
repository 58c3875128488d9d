#include "shelfbeam/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

// The number of bytes of the character at `i`; 0 if they are not UTF-8.
std::size_t character_bytes(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned lead = byte(i);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() - i < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xC0U) != 0x80) return 0;
  // The second byte reveals overlong forms, surrogates and code points beyond U+10FFFF.
  if ((lead == 0xE0 && byte(i + 1) < 0xA0) || (lead == 0xED && byte(i + 1) > 0x9F) ||
      (lead == 0xF0 && byte(i + 1) < 0x90) || (lead == 0xF4 && byte(i + 1) > 0x8F))
    return 0;
  return length;
}

// Control characters, marks and controls of the direction of writing, and invisible characters. The joiners
// U+200C and U+200D are parts of words in some scripts.
bool is_printable(std::uint32_t code) {
  return code >= 0x20 && !(code >= 0x7F && code <= 0x9F) && code != 0xAD && code != 0x61C && code != 0x200B &&
         code != 0x200E && code != 0x200F && !(code >= 0x2028 && code <= 0x202E) &&
         !(code >= 0x2060 && code <= 0x206F) && code != 0xFEFF && !(code >= 0xE0000 && code <= 0xE007F);
}

std::string escaped(const Character& character) {
  if (character.code == '\n') return "\\n";
  const bool is_byte = character.code < 0x80 || !character.is_utf8;
  return is_byte ? fmt::format("\\x{:02x}", character.code) : fmt::format("\\u{:04x}", character.code);
}

// Whether the first characters look like text in units of `bytes`, in which only the byte `low` is in use for
// most characters, and for none of them zero.
bool has_units(std::string_view text, std::size_t bytes, std::size_t low) {
  constexpr std::size_t most = 32;
  const std::size_t units = std::min(text.size() / bytes, most);
  std::size_t narrow = 0;
  for (std::size_t k = 0; k < units; ++k) {
    const std::string_view unit = text.substr(k * bytes, bytes);
    if (unit[low] == '\0') return false;
    if (static_cast<std::size_t>(std::count(unit.begin(), unit.end(), '\0')) == bytes - 1) ++narrow;
  }
  return 2 * narrow > units;
}

// "UTF-16", "UTF-32", or empty for texts whose characters begin with one byte.
std::string_view wide_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv) || has_units(text, 4, 0) ||
      has_units(text, 4, 3))
    return "UTF-32";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || has_units(text, 2, 0) ||
      has_units(text, 2, 1))
    return "UTF-16";
  return {};
}

// The longest word for which a typing error is looked for; the time grows with the square of the length.
constexpr std::size_t longest_word = 100;

}  // namespace

Character character_at(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) -> std::uint32_t { return static_cast<unsigned char>(text[k]); };
  const std::size_t bytes = character_bytes(text, i);
  if (bytes == 0) return {byte(i), 1, false, false};
  constexpr std::array<std::uint32_t, 5> lead_bits{0, 0x7F, 0x1F, 0x0F, 0x07};
  std::uint32_t code = byte(i) & lead_bits[bytes];
  for (std::size_t k = 1; k < bytes; ++k) code = code << 6 | (byte(i + k) & 0x3FU);
  return {code, bytes, is_printable(code), true};
}

std::string nearest(std::string_view word, std::span<const std::string_view> known) {
  if (word.size() > longest_word) return {};
  const std::string lower = lower_case(word);
  for (const std::string_view candidate : known)
    if (lower == lower_case(candidate)) return std::string(candidate);
  constexpr std::size_t shortest_word = 3;  // any two short words are near each other
  if (word.size() < shortest_word) return {};
  std::size_t best = std::numeric_limits<std::size_t>::max();
  std::string_view found;
  for (const std::string_view candidate : known) {
    if (candidate.size() > 2 * longest_word) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return best <= std::max<std::size_t>(2, word.size() / 2) ? std::string(found) : std::string();
}

std::string suggest(std::string_view word, std::span<const std::string_view> known) {
  if (const std::string near = nearest(word, known); !near.empty())
    return fmt::format("did you mean {}?", in_quotes(near));
  constexpr std::size_t most = 300;
  return "known: " + shortened(join(known, ", "), most);
}

std::string join(std::span<const std::string_view> words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

bool matches_glob(std::string_view text, std::string_view pattern) {
  // Greedy with one step back: on a mismatch the last '*' swallows one more character.
  std::size_t t = 0, p = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || (pattern[p] == text[t] && pattern[p] != '*'))) {
      ++t, ++p;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string grouped(std::uint64_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural) {
  if (count == 1) return fmt::format("1 {}", singular);
  return plural.empty() ? fmt::format("{} {}s", grouped(count), singular)
                        : fmt::format("{} {}", grouped(count), plural);
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    if (std::uint64_t eight = 0; text.size() - i >= sizeof(eight)) {
      std::memcpy(&eight, text.data() + i, sizeof(eight));
      if ((eight & 0x8080808080808080U) == 0) {
        i += sizeof(eight);
        continue;
      }
    }
    const std::size_t length = character_bytes(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::string_view without_mark(std::string_view text, const std::string& name, const char* remedy) {
  if (const std::string_view encoding = wide_encoding(text); !encoding.empty())
    throw InputError(name, fmt::format("is {}", encoding), remedy);
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  while (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos)
    text = {};
  else
    text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
  return line;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    result += character.is_printable ? std::string(text.substr(i, character.bytes)) : escaped(character);
    i += character.bytes;
  }
  return result;
}

std::string unprintable_character(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    if (!character.is_printable) return escaped(character);
    i += character.bytes;
  }
  return {};
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80; };
  std::size_t head = most * 2 / 3, tail = text.size() - most / 3;
  while (head > 0 && continues(head)) --head;
  while (tail < text.size() && continues(tail)) ++tail;
  return fmt::format("{}...{}", text.substr(0, head), text.substr(tail));
}

std::string in_quotes(std::string_view value) {
  constexpr std::size_t most = 60;
  return fmt::format("'{}'", shortened(value, most));
}

std::vector<std::uint32_t> matching_ids(std::string_view pattern, std::span<const std::string_view> ids) {
  std::vector<std::uint32_t> found;
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (matches_glob(ids[k], pattern)) found.push_back(static_cast<std::uint32_t>(k));
  return found;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const auto end = line.find(separator);
    fields.push_back(trim(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> to_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars rejects '+'
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

std::optional<std::size_t> to_whole_number(std::string_view text, std::size_t most) {
  std::size_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end || value > most) return std::nullopt;
  if (text.front() == '0' && text.size() > 1) return std::nullopt;
  return value;
}

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    const std::size_t present = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < present ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= present ? digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
  }
  return out;
}

std::string_view amount_problem(double value) {
  if (std::isnan(value)) return "is NaN";
  if (std::isinf(value)) return "is infinite";
  if (value < 0) return "is negative";
  if (value > max_amount) return "is greater than 1e18";
  return {};
}

}  // namespace shelfbeam
