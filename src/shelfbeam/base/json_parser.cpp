#include "shelfbeam/base/json_parser.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

using Node = nlohmann::ordered_json;

namespace {

// The parser's message may quote a whole text of the file.
constexpr std::size_t longest_message = 250;

// The parser's message ("... at line 3, column 7: ...") without its internal id, which users do not need.
std::string parser_message(const std::exception& error) {
  std::string text = error.what();
  if (const auto id = text.find("] "); id != std::string::npos) text.erase(0, id + 2);
  return text;
}

// Adds the line to "number overflow parsing '1e999'", which comes without a position.
std::string overflow_message(const std::exception& error, std::string_view document) {
  std::string message = parser_message(error);
  const auto quote = message.find('\'');
  if (quote == std::string::npos) return message;
  const auto at = document.find(message.substr(quote + 1, message.rfind('\'') - quote - 1));
  if (at == std::string_view::npos) return message;
  return fmt::format("{} at line {}", message, 1 + std::count(document.begin(), document.begin() + at, '\n'));
}

// Deeper than any valid file. The limit is needed because a level costs much more memory than its bracket.
constexpr std::size_t max_levels = 100;
// Objects are searched key by key, so the time grows with the square of their keys.
constexpr std::size_t max_keys = 10'000;

// Checks the nesting and the keys before the document is parsed, in one pass and without keeping values. The
// parser itself would silently use the last value of a duplicate key, and its callbacks take time that grows
// with the square of the elements of a list.
class KeyWatcher {
 public:
  explicit KeyWatcher(const std::string& name) : name_(name) {}

  bool start_object(std::size_t) { return open(false); }
  bool start_array(std::size_t) { return open(true); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    Level& level = open_.back();
    level.key = key;
    bytes_ += sizeof(std::pair<std::string, Node>) + key.size();
    if (!level.keys.insert(key).second)
      throw InputError(name_ + ": " + path(), "is a duplicate key", "remove one of the two");
    if (level.keys.size() > max_keys) {
      open_.pop_back();
      throw InputError(open_.empty() ? name_ : name_ + ": " + path(),
                       fmt::format("has more than {} keys", grouped(max_keys)),
                       "check that it is the right file");
    }
    return true;
  }
  bool null() { return value(); }
  bool boolean(bool) { return value(); }
  bool number_integer(Node::number_integer_t) { return value(); }
  bool number_unsigned(Node::number_unsigned_t) { return value(); }
  bool number_float(Node::number_float_t, const std::string&) { return value(); }
  bool string(std::string& text) {
    bytes_ += sizeof(std::string) + text.size();
    return value();
  }
  bool binary(Node::binary_t&) { return value(); }
  /// The memory of the document, counted without parsing it, bytes. Lists may reserve twice their elements.
  std::size_t bytes() const { return bytes_; }
  // The parser itself reports the error.
  bool parse_error(std::size_t, const std::string&, const std::exception&) { return false; }

 private:
  struct Level {
    bool is_array;
    std::size_t index;
    std::string key;
    std::set<std::string> keys;
  };

  bool open(bool is_array) {
    if (open_.size() >= max_levels)
      throw InputError(name_, fmt::format("has more than {} nested brackets", max_levels),
                       "check that it is the right file");
    open_.push_back({is_array, 0, {}, {}});
    return true;
  }
  bool close() {
    open_.pop_back();
    return value();
  }
  bool value() {
    bytes_ += 2 * sizeof(Node);
    if (!open_.empty()) ++open_.back().index;
    return true;
  }
  std::string path() const {
    std::string path;
    for (const Level& level : open_)
      path += level.is_array ? fmt::format("[{}]", level.index)
                             : (path.empty() ? "" : ".") + shortened(level.key, longest_key);
    return path;
  }

  const std::string& name_;
  std::vector<Level> open_;
  std::size_t bytes_ = 0;
};

// Replaces characters that the parser does not accept by blanks and line breaks, so that positions remain as
// they are in the file. Returns nothing if there are none.
std::optional<std::string> acceptable(std::string_view text) {
  std::optional<std::string> result;
  const auto replace = [&](std::size_t at, char by) {
    if (!result) result = text;
    (*result)[at] = by;
  };
  constexpr std::size_t none = std::string_view::npos;
  std::size_t comma = none;  // behind an element; only blanks and comments have followed
  char before = 0;           // the last character that is neither blank nor part of a comment
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\r' && !text.substr(i + 1).starts_with('\n')) replace(i, '\n');
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    if (text.substr(i).starts_with("//") || text.substr(i).starts_with("/*")) {
      const std::size_t end = text[i + 1] == '/' ? text.find_first_of("\r\n", i) : text.find("*/", i + 2);
      if (end == none) break;
      i = text[i + 1] == '/' ? end - 1 : end + 1;
      continue;
    }
    if (comma != none && (c == ']' || c == '}')) replace(comma, ' ');
    comma = none;
    if (c == ',' && before != 0 && std::string_view("[{:,").find(before) == std::string_view::npos) comma = i;
    before = c;
    if (c == '"')
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
  }
  return result;
}

// "file: line 3", the first line for which `is_wrong`.
template <class Predicate>
std::string first_line(std::string_view text, const std::string& name, const Predicate& is_wrong) {
  std::size_t line = 1;
  while (!text.empty() && !is_wrong(take_line(text))) ++line;
  return fmt::format("{}: line {}", name, line);
}

// A picture or an HDF5 file is not a text with a fault to correct.
bool begins_like_json(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos &&
         std::string_view("{[/").find(text[first]) != std::string_view::npos;
}

// The parser would take a null character for the end. Null characters at the end are those of padding.
std::string_view without_nulls(std::string_view text, const std::string& name) {
  text = text.substr(0, text.find_last_not_of(std::string_view("\0 \t\r\n", 5)) + 1);
  const auto has_null = [](std::string_view part) { return part.find('\0') != std::string_view::npos; };
  if (begins_like_json(text) && has_null(text))
    throw InputError(first_line(text, name, has_null), "has a null character", "remove it");
  return text;
}

Node parse_strictly(std::string_view text, const std::string& name) {
  KeyWatcher keys(name);
  try {
    Node::sax_parse(text, &keys, Node::input_format_t::json, true, true);
    if (keys.bytes() > memory_limit())
      throw MemoryError(
          name,
          fmt::format("requires {:.3g} GB of memory; the limit is {:.3g} GB",
                      1e-9 * static_cast<double>(keys.bytes()), 1e-9 * static_cast<double>(memory_limit())),
          "check that it is the right file, or use a machine with more memory");
    return Node::parse(text, nullptr, true, true);
  } catch (const Node::out_of_range& error) {
    throw InputError(
        name, "has a number out of range (" + shortened(overflow_message(error, text), longest_message) + ")",
        "correct the number");
  } catch (const Node::exception& error) {
    const auto is_foreign = [](std::string_view line) { return !is_utf8(line); };
    if (begins_like_json(text) && is_foreign(text))
      throw InputError(first_line(text, name, is_foreign), "is not UTF-8", save_as_utf8);
    throw InputError(name, "is not valid JSON (" + shortened(parser_message(error), longest_message) + ")",
                     "correct the syntax");
  }
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text, const std::string& name) {
  text = without_nulls(without_mark(text, name), name);
  const std::optional<std::string> replaced = acceptable(text);
  return parse_strictly(replaced ? *replaced : text, name);
}

}  // namespace shelfbeam
