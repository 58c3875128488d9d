#include "shelfbeam/base/json.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"
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
  std::string name = shortened(key, longest_key);
  return path.empty() ? name : fmt::format("{}.{}", path, name);
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

JsonCursor JsonCursor::parse(std::string_view text, const std::string& name, std::size_t memory) {
  auto document = std::make_shared<const Document>(Document{name, parse_json(text, name, memory)});
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

void JsonCursor::fail(const std::string& problem, const std::string& suggestion, FindingCode code,
                      FindingValues values) const {
  throw JsonError(where(), path_, problem, suggestion, code, std::move(values));
}

void JsonCursor::fail_kind(const char* expected) const {
  fail("is " + kind(as_node(node_)), fmt::format("{} is expected", expected), FindingCode::wrong_kind);
}

void JsonCursor::fail_limits(const std::string& problem, double value, double low, double high,
                             const std::string& suggestion) const {
  fail(problem, suggestion, FindingCode::outside_limits, {value, low, high});
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
  const std::vector<JsonError> errors = unknown_keys(known);
  if (!errors.empty()) throw JsonError(errors.front());
}

std::vector<JsonError> JsonCursor::unknown_keys(std::span<const std::string_view> known) const {
  if (!is_object()) fail_kind("an object { ... }");
  std::vector<JsonError> errors;
  for (const auto& [key, value] : as_node(node_).items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      errors.push_back({where(member_path(path_, key)),
                        path_,
                        fmt::format("has the unknown key {}", in_quotes(key)),
                        suggest(key, known),
                        FindingCode::unknown_key,
                        {key}});
  return errors;
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  if (!is_object()) fail_kind("an object { ... }");
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
  fail(fmt::format("is missing the key '{}'", key), "add it", FindingCode::missing_key, {std::string(key)});
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  if (!is_object()) fail_kind("an object { ... }");
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
  if (!is_array()) fail_kind("an array [ ... ]");
  return as_node(node_).size();
}

JsonCursor JsonCursor::element(std::size_t index) const {
  return JsonCursor(document_, &as_node(node_)[index], fmt::format("{}[{}]", path_, index), unit_);
}

double JsonCursor::number() const {
  if (!is_number()) fail_kind("a number");
  const auto value = as_node(node_).get<double>();
  if (!std::isfinite(value)) fail("is not finite", "a finite number is expected");
  return value;
}

double JsonCursor::number(double low, double high) const {
  const double value = number();
  if (value < low || value > high)
    fail_limits(fmt::format("is {}, which is outside {} to {}", value, low, high), value, low, high);
  return value;
}

double JsonCursor::metres() const {
  return to_metres(number(), unit_);
}

double JsonCursor::metres(double low, double high) const {
  const double value = metres();
  if (!(value >= low && value <= high))
    fail_limits(fmt::format("is {}, which is outside {} to {} m", length_text(), low, high), value, low,
                high);
  return value;
}

std::string JsonCursor::length_text() const {
  return fmt::format("{} {}", number(), to_text(unit_));
}

double JsonCursor::positive() const {
  const double value = number();
  if (value <= 0) fail_limits(fmt::format("is {}", value), value, 0, HUGE_VAL, "it must be greater than 0");
  return value;
}

double JsonCursor::non_negative() const {
  const double value = number();
  if (value < 0) fail_limits(fmt::format("is {}", value), value, 0, HUGE_VAL, "it must not be negative");
  return value;
}

std::int64_t JsonCursor::integer(std::int64_t low, std::int64_t high) const {
  const double value = number(static_cast<double>(low), static_cast<double>(high));
  if (value != std::floor(value)) fail(fmt::format("is {}", value), "a whole number is expected");
  return static_cast<std::int64_t>(value);
}

std::uint64_t JsonCursor::natural() const {
  if (!as_node(node_).is_number_unsigned()) fail("is not a whole number of at least 0", "use one");
  return as_node(node_).get<std::uint64_t>();
}

bool JsonCursor::boolean() const {
  if (!as_node(node_).is_boolean()) fail_kind("true or false");
  return as_node(node_).get<bool>();
}

std::string JsonCursor::text() const {
  if (!is_string()) fail_kind("a string");
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
    fail(fmt::format("has the unknown value {}", in_quotes(word)), suggest(word, known),
         FindingCode::unknown_name, {word});
  return word;
}

}  // namespace shelfbeam
