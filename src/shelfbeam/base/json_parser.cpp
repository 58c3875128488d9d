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

// Objects are searched key by key, so the time grows with the square of their keys.
constexpr std::size_t max_keys = 10'000;

// Makes the document from the events of the parser, which alone would silently use the last value of a
// duplicate key. Elements are moved into their container when it is complete, because an object that grows
// copies all its members.
class DocumentBuilder {
 public:
  DocumentBuilder(const std::string& name, std::size_t memory) : name_(name), limit_(memory) {}

  Node document() { return std::move(document_); }

  bool start_object(std::size_t) { return open(false); }
  bool start_array(std::size_t) { return open(true); }
  bool end_object() {
    Level level = std::move(open_.back());
    open_.pop_back();
    Node node = Node::object();
    auto& members = node.get_ref<Node::object_t&>();
    members.reserve(level.values.size());
    for (std::size_t k = 0; k < level.values.size(); ++k)
      members.emplace_back(std::move(level.keys[k]), std::move(level.values[k]));
    return add(std::move(node));
  }
  bool end_array() {
    Node node = std::move(open_.back().values);
    open_.pop_back();
    return add(std::move(node));
  }
  bool key(std::string& key) {
    Level& level = open_.back();
    level.keys.push_back(key);
    bytes_ += sizeof(std::pair<std::string, Node>) + key.size();
    if (!level.known.insert(key).second)
      throw InputError(name_ + ": " + path(), "is a duplicate key", "remove one of the two");
    if (level.keys.size() > max_keys) {
      open_.pop_back();
      throw InputError(open_.empty() ? name_ : name_ + ": " + path(),
                       fmt::format("has more than {} keys", grouped(max_keys)),
                       "check that it is the right file");
    }
    return true;
  }
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Node::number_integer_t value) { return add(value); }
  bool number_unsigned(Node::number_unsigned_t value) { return add(value); }
  bool number_float(Node::number_float_t value, const std::string&) { return add(value); }
  bool string(std::string& text) {
    bytes_ += sizeof(std::string) + text.size();
    return add(std::move(text));
  }
  bool binary(Node::binary_t&) { return false; }  // not in JSON
  template <class Error>
  bool parse_error(std::size_t, const std::string&, const Error& error) {
    throw Error(error);
  }

 private:
  // Of the blocks of a list or an object, without its elements.
  static constexpr std::size_t container_bytes = 64;

  struct Level {
    bool is_array;
    std::vector<std::string> keys = {};
    std::set<std::string> known = {};  ///< the same keys
    std::vector<Node> values = {};
  };

  bool open(bool is_array) {
    if (open_.size() >= max_json_levels)
      throw InputError(name_, fmt::format("has more than {} nested brackets", max_json_levels),
                       "check that it is the right file");
    open_.push_back({is_array});
    bytes_ += container_bytes;
    return true;
  }
  bool add(Node value) {
    bytes_ += 2 * sizeof(Node);  // a list may reserve twice its elements
    if (bytes_ > limit_)
      throw MemoryError(name_,
                        fmt::format("requires more than {:.3g} GB of memory, the limit",
                                    1e-9 * static_cast<double>(limit_)),
                        "check that it is the right file, or use a machine with more memory");
    if (open_.empty())
      document_ = std::move(value);
    else
      open_.back().values.push_back(std::move(value));
    return true;
  }
  std::string path() const {
    std::string path;
    for (const Level& level : open_)
      path += level.is_array ? fmt::format("[{}]", level.values.size())
                             : (path.empty() ? "" : ".") + shortened(level.keys.back(), longest_key);
    return path;
  }

  const std::string& name_;
  const std::size_t limit_;
  std::size_t bytes_ = 0;  ///< of the document
  std::vector<Level> open_;
  Node document_;
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

// The character at which the parser has stopped, if it is one that JSON has in texts only.
std::optional<Character> foreign_character(std::string_view text, const Node::parse_error& error) {
  if (error.byte == 0 || error.byte > text.size()) return std::nullopt;
  const Character character = character_at(text, error.byte - 1);
  return character.bytes > 1 ? std::optional(character) : std::nullopt;
}

Node parse_strictly(std::string_view text, const std::string& name, std::size_t memory) {
  DocumentBuilder builder(name, memory);
  try {
    Node::sax_parse(text, &builder, Node::input_format_t::json, true, true);
    return builder.document();
  } catch (const Node::out_of_range& error) {
    throw InputError(
        name, "has a number out of range (" + shortened(overflow_message(error, text), longest_message) + ")",
        "correct the number");
  } catch (const Node::parse_error& error) {
    const auto is_foreign = [](std::string_view line) { return !is_utf8(line); };
    if (begins_like_json(text) && is_foreign(text))
      throw InputError(first_line(text, name, is_foreign), "is not UTF-8", save_as_utf8);
    if (const auto found = foreign_character(text, error))
      throw InputError(
          fmt::format(
              "{}: line {}", name,
              1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(error.byte), '\n')),
          fmt::format("has the character {} (U+{:04X}) outside of a text",
                      in_quotes(text.substr(error.byte - 1, found->bytes)), found->code),
          "write texts in straight double quotes, and plain blanks between them");
    throw InputError(name, "is not valid JSON (" + shortened(parser_message(error), longest_message) + ")",
                     "correct the syntax");
  }
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text, const std::string& name, std::size_t memory) {
  text = without_nulls(without_mark(text, name), name);
  const std::optional<std::string> replaced = acceptable(text);
  return parse_strictly(replaced ? *replaced : text, name, memory == 0 ? memory_limit() : memory);
}

}  // namespace shelfbeam
