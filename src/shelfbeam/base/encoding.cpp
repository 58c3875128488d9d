#include "shelfbeam/base/encoding.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <iconv.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

// Its name in iconv: Windows' supersets of the East Asian ones, as browsers read them.
const char* iconv_name(Encoding encoding) {
  switch (encoding) {
    case Encoding::windows_1252:
      return "CP1252";
    case Encoding::windows_1250:
      return "CP1250";
    case Encoding::windows_1251:
      return "CP1251";
    case Encoding::cp850:
      return "CP850";
    case Encoding::macintosh:
      return "MACINTOSH";
    case Encoding::shift_jis:
      return "CP932";
    case Encoding::gbk:
      return "GBK";
    case Encoding::windows_1253:
      return "CP1253";
    case Encoding::windows_1254:
      return "CP1254";
    case Encoding::windows_1255:
      return "CP1255";
    case Encoding::windows_1256:
      return "CP1256";
    case Encoding::euc_kr:
      return "CP949";
    case Encoding::big5:
      return "CP950";
  }
  return "";
}

bool has_wide_letters(Encoding encoding) {
  return encoding == Encoding::shift_jis || encoding == Encoding::gbk || encoding == Encoding::euc_kr ||
         encoding == Encoding::big5;
}

constexpr std::string_view replacement = "\uFFFD";

struct Converted {
  std::string text;
  bool is_whole = true;
};

// `is_part`: the last character may be cut off.
Converted converted(std::string_view bytes, const char* from, bool is_part = false) {
  const iconv_t converter = iconv_open("UTF-8", from);
  if (reinterpret_cast<std::intptr_t>(converter) == -1) return {std::string(replacement), false};
  Converted result;
  // iconv leaves characters as they are, but takes them as not const.
  std::string rest(bytes);
  char* in = rest.data();
  std::size_t left = rest.size();
  std::array<char, 4096> buffer{};
  while (left > 0) {
    char* out = buffer.data();
    std::size_t room = buffer.size();
    const bool is_done = iconv(converter, &in, &left, &out, &room) != std::size_t(-1);
    const int reason = is_done ? 0 : errno;
    result.text.append(buffer.data(), buffer.size() - room);
    if (is_done || reason == E2BIG) continue;
    if (reason == EINVAL && is_part) break;
    result.text += replacement;
    result.is_whole = false;
    ++in;
    --left;
  }
  iconv_close(converter);
  return result;
}

// The scripts of letters; other ones are those of East Asia.
enum class Script : std::uint8_t { none, latin, greek, cyrillic, hebrew, arabic, other };

Script script_of(std::uint32_t code) {
  const auto within = [code](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  if (within('a', 'z') || within('A', 'Z') || code == 0xAA || code == 0xBA || within(0x1E00, 0x1EFF) ||
      (within(0xC0, 0x24F) && code != 0xD7 && code != 0xF7))
    return Script::latin;
  if (within(0x386, 0x3FF) && code != 0x387) return Script::greek;
  if (within(0x400, 0x52F)) return Script::cyrillic;
  if (within(0x5D0, 0x5F4)) return Script::hebrew;
  if (within(0x620, 0x64A) || within(0x66E, 0x6D3)) return Script::arabic;
  if (code == 0xB5 || within(0x3041, 0x30FF) || within(0x3400, 0x9FFF) || within(0xAC00, 0xD7A3) ||
      within(0xF900, 0xFAFF) || within(0xFF66, 0xFF9D))
    return Script::other;
  return Script::none;
}

bool is_upper(std::uint32_t code) {
  const auto within = [code](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  if (within(0x139, 0x148) || within(0x179, 0x17E)) return code % 2 == 1;
  if (within(0x100, 0x17F)) return code % 2 == 0;
  return within('A', 'Z') || (within(0xC0, 0xDE) && code != 0xD7) ||
         (within(0x386, 0x3AB) && code != 0x387 && code != 0x390) || within(0x400, 0x42F) || code == 0x490;
}

bool is_kana(std::uint32_t code) {
  return code >= 0x3040 && code <= 0x30FF;
}

bool ends_word(std::uint32_t code) {
  return code <= ' ' || code == 0xA0 || code == 0x3000 || (code >= '0' && code <= '9') ||
         (code < 0x80 &&
          std::string_view(";,|\"()/.:_-").find(static_cast<char>(code)) != std::string_view::npos);
}

struct Word {
  std::vector<std::uint32_t> letters;
  std::size_t begin = 0, end = 0;  ///< bytes in the text
};

// Calls `use` for each word with characters beyond ASCII until it returns false.
template <class Use>
void each_foreign_word(std::string_view text, const Use& use) {
  Word word;
  bool is_foreign = false, continues = true;
  for (std::size_t i = 0; i <= text.size() && continues;) {
    const Character character = i < text.size() ? character_at(text, i) : Character{' ', 1, true, true};
    if (ends_word(character.code)) {
      word.end = i;
      if (is_foreign) continues = use(word);
      word = {{}, i + character.bytes, 0};
      is_foreign = false;
    } else {
      word.letters.push_back(character.code);
      is_foreign = is_foreign || character.code >= 0x80;
    }
    i += character.bytes;
  }
}

// How likely people have written a word. Capitals within words, accents in a row, scripts side by side and
// symbols among letters are rare.
double likelihood_of(const Word& word) {
  std::set<Script> scripts;
  for (const std::uint32_t code : word.letters)
    if (const Script script = script_of(code); script != Script::none) scripts.insert(script);
  double sum = 0;
  std::uint32_t before = 0;
  for (const std::uint32_t code : word.letters) {
    const Script script = script_of(code);
    const bool is_odd = script == Script::none || scripts.size() > 1 ||
                        (is_upper(code) && !is_upper(before) && script_of(before) != Script::none) ||
                        (script == Script::latin && before >= 0x80);
    if (code >= 0x80) sum += is_odd ? -1 : 0.5;
    before = code;
  }
  // Kana are in Japanese texts alone; their half-width forms are in other encodings' misreadings.
  if (std::ranges::any_of(word.letters, is_kana)) sum += 1;
  const auto is_misread = [](std::uint32_t code) {
    return (code >= 0xFF61 && code <= 0xFF9F) || code == 0xFFFD;
  };
  if (std::ranges::any_of(word.letters, is_misread)) sum -= 3;
  return sum;
}

Encoding guessed_encoding(std::string_view bytes) {
  constexpr std::size_t sampled = 20'000;
  const std::string_view sample = bytes.substr(0, sampled);
  Encoding likeliest = Encoding::windows_1252;
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& [name, encoding] : names_of<Encoding>) {
    double sum = 0;
    each_foreign_word(converted(sample, iconv_name(encoding), true).text, [&](const Word& word) {
      sum += likelihood_of(word);
      return true;
    });
    // Texts in two bytes have half as many letters.
    if (sum > 0 && has_wide_letters(encoding)) sum *= 2;
    if (sum <= best) continue;
    best = sum;
    likeliest = encoding;
  }
  return likeliest;
}

}  // namespace

DecodedText decoded_text(std::string bytes, std::optional<Encoding> chosen) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  DecodedText result;
  const auto convert = [&](std::string_view content, const char* from) {
    auto [text, is_whole] = converted(content, from);
    result.text = std::move(text);
    result.is_whole = is_whole;
  };
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    convert(std::string_view(bytes).substr(2), bytes[0] == '\xFF' ? "UTF-16LE" : "UTF-16BE");
  } else if (is_utf8(bytes)) {
    while (bytes.starts_with(mark)) bytes.erase(0, mark.size());
    result.text = std::move(bytes);
  } else {
    result.encoding = chosen ? *chosen : guessed_encoding(bytes);
    convert(bytes, iconv_name(*result.encoding));
    each_foreign_word(result.text, [&](const Word& word) {
      result.example = result.text.substr(word.begin, word.end - word.begin);
      return false;
    });
  }
  if (result.text.ends_with('\x1A')) result.text.pop_back();
  return result;
}

}  // namespace shelfbeam
