#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// Encodings of tables that spreadsheets and databases write and that the files do not show.
enum class Encoding : std::uint8_t {
  windows_1252,
  windows_1250,
  windows_1251,
  cp850,
  macintosh,
  shift_jis,
  gbk,
  windows_1253,
  windows_1254,
  windows_1255,
  windows_1256,
  euc_kr,
  big5,
};
/// The more frequent ones first.
template <>
inline constexpr auto names_of<Encoding> = std::to_array<Named<Encoding>>({
    {"windows-1252", Encoding::windows_1252},
    {"windows-1250", Encoding::windows_1250},
    {"windows-1251", Encoding::windows_1251},
    {"cp850", Encoding::cp850},
    {"macintosh", Encoding::macintosh},
    {"shift_jis", Encoding::shift_jis},
    {"gbk", Encoding::gbk},
    {"windows-1253", Encoding::windows_1253},
    {"windows-1254", Encoding::windows_1254},
    {"windows-1255", Encoding::windows_1255},
    {"windows-1256", Encoding::windows_1256},
    {"euc-kr", Encoding::euc_kr},
    {"big5", Encoding::big5},
});

struct DecodedText {
  std::string text;                  ///< UTF-8; U+FFFD for bytes that have no character in the encoding
  std::optional<Encoding> encoding;  ///< nothing if the file shows its own: UTF-8, or UTF-16 with a mark
  bool is_whole = true;              ///< all bytes have a character
  std::string example;               ///< the first word that depends on the encoding
};

/// The text of a table without its byte order mark and without the Ctrl-Z at the end of files from DOS. If it
/// is neither UTF-8 nor UTF-16 with a mark, it has the `chosen` encoding, or the one that makes the
/// likeliest words of its first 20,000 bytes.
DecodedText decoded_text(std::string bytes, std::optional<Encoding> chosen = {});

}  // namespace shelfbeam
