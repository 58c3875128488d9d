#include "shelfbeam/base/json.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

using Node = nlohmann::ordered_json;

struct JsonCursor::Document {
  std::string name;
  Node root;
  Origins origins = {};  ///< by the whole path

  const Origin* origin_of(std::string path) const {
    if (origins.empty()) return nullptr;
    for (;;) {
      if (const auto found = origins.find(path); found != origins.end()) return &found->second;
      const auto end = path.find_last_of(".[");
      if (end == std::string::npos) return nullptr;
      path.resize(end);
    }
  }
};

namespace {

// In messages, bytes of a key and of the parser's message, which may quote a whole text of the file.
constexpr std::size_t longest_name = 60, longest_message = 250;

const Node& as_node(const void* pointer) {
  return *static_cast<const Node*>(pointer);
}

std::string kind(const Node& node) {
  if (node.is_object()) return "an object";
  if (node.is_array()) return "an array";
  if (node.is_string()) return "a string";
  if (node.is_number()) return "a number";
  if (node.is_boolean()) return "true or false";
  return "null";
}

std::string member_path(const std::string& path, std::string_view key) {
  std::string name = shortened(key, longest_name);
  return path.empty() ? name : fmt::format("{}.{}", path, name);
}

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
                             : (path.empty() ? "" : ".") + shortened(level.key, longest_name);
    return path;
  }

  const std::string& name_;
  std::vector<Level> open_;
  std::size_t bytes_ = 0;
};

Node parse_strictly(std::string_view text, const std::string& name) {
  KeyWatcher keys(name);
  try {
    Node::sax_parse(text, &keys, Node::input_format_t::json, true, true);
    if (keys.bytes() > memory_limit())
      throw InputError(
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
    throw InputError(name, "is not valid JSON (" + shortened(parser_message(error), longest_message) + ")",
                     "correct the syntax");
  }
}

}  // namespace

JsonCursor::JsonCursor(std::shared_ptr<const Document> document, const void* node, std::string path,
                       LengthUnit unit)
    : document_(std::move(document)), node_(node), path_(std::move(path)), unit_(unit) {}

JsonCursor JsonCursor::with_unit(LengthUnit unit) const {
  return {document_, node_, path_, unit};
}

const nlohmann::ordered_json& JsonCursor::value() const {
  return as_node(node_);
}

JsonCursor JsonCursor::replaced(nlohmann::ordered_json value, const Origins& origins) const {
  Origins whole = origins.empty() ? document_->origins : Origins{};
  for (const auto& [part, origin] : origins)
    whole.emplace(path_.empty() || part.empty() ? path_ + part : fmt::format("{}.{}", path_, part), origin);
  auto document =
      std::make_shared<const Document>(Document{document_->name, std::move(value), std::move(whole)});
  const void* root = &document->root;
  return {std::move(document), root, path_, unit_};
}

JsonCursor JsonCursor::parse(std::string_view text, const std::string& name) {
  auto document = std::make_shared<const Document>(Document{name, parse_strictly(text, name)});
  const void* root = &document->root;
  return {std::move(document), root, "", LengthUnit::m};
}

JsonCursor JsonCursor::parse_file(const std::filesystem::path& path) {
  return parse(read_file(path), path.string());
}

std::string JsonCursor::where() const {
  return where(path_);
}

std::string JsonCursor::where(const std::string& part) const {
  std::string text = path_.empty() ? document_->name : document_->name + ": " + path_;
  const Origin* origin = document_->origin_of(part);
  if (origin != nullptr && !origin->note.empty()) text += fmt::format(" ({})", origin->note);
  return text;
}

const std::string& JsonCursor::file() const {
  return document_->name;
}

void JsonCursor::fail(const std::string& problem, const std::string& suggestion) const {
  throw InputError(where(), problem, suggestion);
}

bool JsonCursor::is_object() const {
  return as_node(node_).is_object();
}
bool JsonCursor::is_array() const {
  return as_node(node_).is_array();
}
bool JsonCursor::is_null() const {
  return as_node(node_).is_null();
}

bool JsonCursor::is_string() const {
  return as_node(node_).is_string();
}
bool JsonCursor::is_number() const {
  return as_node(node_).is_number();
}

void JsonCursor::expect_keys(std::span<const std::string_view> known) const {
  if (!is_object()) fail("is " + kind(as_node(node_)), "an object { ... } is expected");
  for (const auto& [key, value] : as_node(node_).items()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw InputError(where(member_path(path_, key)), fmt::format("has the unknown key {}", in_quotes(key)),
                       suggest(key, known));
  }
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  if (!is_object()) fail("is " + kind(as_node(node_)), "an object { ... } is expected");
  const auto found = as_node(node_).find(std::string(key));
  if (found == as_node(node_).end()) return std::nullopt;
  return member(key, &*found);
}

JsonCursor JsonCursor::member(std::string_view key, const void* node) const {
  std::string path = member_path(path_, key);
  const auto origin = document_->origins.find(path);
  const LengthUnit unit = origin == document_->origins.end() ? unit_ : origin->second.unit;
  return {document_, node, std::move(path), unit};
}

JsonCursor JsonCursor::operator[](std::string_view key) const {
  if (auto found = find(key)) return *found;
  fail(fmt::format("is missing the key '{}'", key), "add it");
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  if (!is_object()) fail("is " + kind(as_node(node_)), "an object { ... } is expected");
  std::vector<std::pair<std::string, JsonCursor>> result;
  for (const auto& [key, value] : as_node(node_).items()) result.emplace_back(key, member(key, &value));
  return result;
}

std::vector<JsonCursor> JsonCursor::elements() const {
  std::vector<JsonCursor> result;
  for (std::size_t i = 0; i < size(); ++i) result.push_back(element(i));
  return result;
}

std::size_t JsonCursor::size() const {
  if (!is_array()) fail("is " + kind(as_node(node_)), "an array [ ... ] is expected");
  return as_node(node_).size();
}

JsonCursor JsonCursor::element(std::size_t index) const {
  return JsonCursor(document_, &as_node(node_)[index], fmt::format("{}[{}]", path_, index), unit_);
}

double JsonCursor::number() const {
  if (!is_number()) fail("is " + kind(as_node(node_)), "a number is expected");
  const auto value = as_node(node_).get<double>();
  if (!std::isfinite(value)) fail("is not finite", "a finite number is expected");
  return value;
}

double JsonCursor::number(double low, double high) const {
  const double value = number();
  if (value < low || value > high)
    fail(fmt::format("is {}, which is outside {} to {}", value, low, high), "use a value in that range");
  return value;
}

double JsonCursor::metres() const {
  return to_metres(number(), unit_);
}

double JsonCursor::metres(double low, double high) const {
  const double value = metres();
  if (!(value >= low && value <= high))
    fail(fmt::format("is {}, which is outside {} to {} m", length_text(), low, high),
         "use a value in that range");
  return value;
}

std::string JsonCursor::length_text() const {
  return fmt::format("{} {}", number(), to_text(unit_));
}

double JsonCursor::positive() const {
  const double value = number();
  if (value <= 0) fail(fmt::format("is {}", value), "it must be greater than 0");
  return value;
}

double JsonCursor::non_negative() const {
  const double value = number();
  if (value < 0) fail(fmt::format("is {}", value), "it must not be negative");
  return value;
}

std::int64_t JsonCursor::integer(std::int64_t low, std::int64_t high) const {
  const double value = number(static_cast<double>(low), static_cast<double>(high));
  if (value != std::floor(value)) fail(fmt::format("is {}", value), "a whole number is expected");
  return static_cast<std::int64_t>(value);
}

bool JsonCursor::boolean() const {
  if (!as_node(node_).is_boolean()) fail("is " + kind(as_node(node_)), "true or false is expected");
  return as_node(node_).get<bool>();
}

std::string JsonCursor::text() const {
  if (!is_string()) fail("is " + kind(as_node(node_)), "a string is expected");
  return as_node(node_).get<std::string>();
}

std::vector<double> JsonCursor::numbers() const {
  std::vector<double> values;
  for (const JsonCursor& element : elements()) values.push_back(element.number());
  return values;
}

std::vector<double> JsonCursor::numbers(std::size_t count) const {
  auto values = numbers();
  if (values.size() != count)
    fail(fmt::format("has {} numbers", values.size()), fmt::format("{} are expected", count));
  return values;
}

std::string JsonCursor::one_of(std::span<const std::string_view> known) const {
  std::string word = text();
  if (std::find(known.begin(), known.end(), word) == known.end())
    fail(fmt::format("has the unknown value {}", in_quotes(word)), suggest(word, known));
  return word;
}

}  // namespace shelfbeam
