#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// An error at a position of a JSON document.
class JsonError : public InputError {
 public:
  JsonError(const std::string& where, std::string path, const std::string& problem,
            const std::string& suggestion, FindingCode code, FindingValues values)
      : InputError(where, problem, suggestion),
        path_(std::move(path)),
        code_(code),
        values_(std::move(values)) {}

  const std::string& path() const { return path_; }
  FindingCode code() const { return code_; }
  const FindingValues& values() const { return values_; }

 private:
  std::string path_;
  FindingCode code_;
  FindingValues values_;
};

/// A position in a JSON document that is read strictly. Every access states the expected type and range; any
/// other value throws InputError with the file and the JSON path ("store.json: fixtures[3].labels.spacing").
class JsonCursor {
 public:
  /// As parse_json.
  static JsonCursor parse(std::string_view text, const std::string& name, std::size_t memory = 0);
  static JsonCursor parse_file(const std::filesystem::path& path);

  /// The unit of `metres`, here and at all positions below; m unless `with_unit` has set it.
  LengthUnit unit() const { return unit_; }
  JsonCursor with_unit(LengthUnit unit) const;

  /// The value at this position.
  const nlohmann::ordered_json& value() const;
  /// The source of a part of a value: a note behind its path in errors, and the unit of its lengths.
  struct Origin {
    std::string note;
    LengthUnit unit = LengthUnit::m;
  };
  /// By the path from the value to the part ("depth", "labels.spacing"), "" for the value itself. Other parts
  /// have the origin of the part that contains them.
  using Origins = std::map<std::string, Origin>;
  /// The same position with another value. Without `origins`, its parts keep the present ones.
  JsonCursor replaced(nlohmann::ordered_json value, const Origins& origins = {}) const;

  /// "file: path" for errors.
  std::string where() const;
  /// The name of the file.
  const std::string& file() const;
  /// Throws JsonError.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion = {},
                         FindingCode code = FindingCode::invalid, FindingValues values = {}) const;
  [[noreturn]] void fail_limits(const std::string& problem, double value, double low, double high,
                                const std::string& suggestion = "use a value in that range") const;

  bool is_object() const;
  bool is_array() const;
  bool is_string() const;
  bool is_number() const;
  bool is_null() const;

  /// Objects: throws if the value is not an object or has a key outside `known` (suggests the nearest).
  void expect_keys(std::initializer_list<std::string_view> known) const {
    expect_keys(std::span{known.begin(), known.size()});
  }
  void expect_keys(std::span<const std::string_view> known) const;
  /// The errors that `expect_keys` throws for keys.
  std::vector<JsonError> unknown_keys(std::span<const std::string_view> known) const;
  JsonCursor operator[](std::string_view key) const;                ///< throws when the key is missing
  std::optional<JsonCursor> find(std::string_view key) const;       ///< nothing when the key is missing
  std::vector<std::pair<std::string, JsonCursor>> members() const;  ///< in the order of the file

  /// Arrays.
  std::vector<JsonCursor> elements() const;
  std::size_t size() const;
  JsonCursor element(std::size_t index) const;  ///< precondition: below `size()`

  double number() const;                         ///< finite
  double number(double low, double high) const;  ///< within [low, high]
  double positive() const;                       ///< > 0
  double non_negative() const;
  double metres() const;                         ///< a finite length, in metres
  double metres(double low, double high) const;  ///< a length within [low, high] metres
  std::string length_text() const;               ///< the number and its unit of length, for messages
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  std::uint64_t natural() const;  ///< any whole number of at least 0, exactly
  bool boolean() const;
  std::string text() const;
  std::vector<double> numbers(std::size_t count) const;  ///< array of exactly `count` finite numbers
  std::vector<double> numbers() const;
  /// A text out of `known`; the error for any other text suggests the nearest.
  std::string choice(std::initializer_list<std::string_view> known) const {
    return choice(std::span{known.begin(), known.size()});
  }
  std::string choice(std::span<const std::string_view> known) const { return one_of(known); }
  /// The enumerator whose name is given; `known` may be limited to the first names of the enumeration.
  template <class Enum>
  Enum choice(std::span<const Named<Enum>> known = names_of<Enum>) const {
    std::vector<std::string_view> names;
    for (const Named<Enum>& entry : known) names.push_back(entry.name);
    return *from_text<Enum>(one_of(names));
  }

 private:
  struct Document;
  JsonCursor member(std::string_view key, const void* node) const;
  /// "file: path", with the note of the origin of `part`.
  std::string where(const std::string& part) const;
  std::string one_of(std::span<const std::string_view> known) const;
  [[noreturn]] void fail_kind(const char* expected) const;
  JsonCursor(std::shared_ptr<const Document> document, const void* node, std::string path, LengthUnit unit);

  std::shared_ptr<const Document> document_;
  const void* node_;
  std::string path_;
  LengthUnit unit_;
};

}  // namespace shelfbeam
