#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/ids.hpp"

namespace shelfbeam {

class JsonCursor;

/// The kinds of numbers, each with its limits and its unit of measure.
enum class Scalar : std::uint8_t {
  length,      ///< m, 1 mm to 1 km
  distance,    ///< m, 0 to 1 km
  extent,      ///< m, 0 for a point, or 0.1 mm to 10 m
  coordinate,  ///< m, within 10 km of the origin
  degrees,     ///< up to a full turn in either direction
  share,       ///< 0 to 1
  quantity,    ///< 1e-12 to 1e9
  amount,      ///< 0 to 1e9
  number,      ///< finite
};

/// The lists of the store whose members have names.
enum class NameList : std::uint8_t { material, label_type, transceiver_type };

/// The description of a key.
struct Field {
  std::string_view says = {};  ///< its meaning, in Markdown
  /// Limits narrower than those of the kind, and the remedy for values outside them.
  double least = -HUGE_VAL, most = HUGE_VAL;
  std::string_view remedy = {};
  /// `inspect` warns of values outside these limits, with this text: "1 to 4 are typical".
  double usual_least = -HUGE_VAL, usual_most = HUGE_VAL;
  std::string_view usual = {};
  std::size_t fewest = 0, longest = 0;  ///< members of a list or characters of a text; 0: no limit
  std::string_view pattern = {};        ///< of the keys of an object, for schemas
  std::string_view unit = {};           ///< of measure, unless the kind gives it
  bool is_name = false;                 ///< of a text: an id or a name, not empty and printable
  bool is_optional = false;             ///< without the key, the struct keeps its value
  std::string_view instead = {};        ///< another key of the element that gives the value, too
  std::string_view otherwise = {};      ///< the default in words, unless it is the value of an empty struct
  bool is_written = true;               ///< to the resolved store
  bool one_for_all = false;             ///< of names: they have the given keys, or one name is for all keys
};

/// A value of a form that other values do not have.
struct CustomValue {
  std::function<void(const JsonCursor&)> read;
  std::function<nlohmann::ordered_json()> write;
  std::string_view schema;  ///< JSON
};

/// A visitor of the stored values of a struct. The function `fields` of each struct describes them once, for
/// the reader, the writer, the JSON schema, the tables of the documentation, and the warnings about unusual
/// values. It is called on an empty struct to be read or to be documented, or on a copy to be written.
///
/// The functions for a key return whether they changed the value.
class Fields {
 public:
  using Part = std::function<void(Fields&)>;

  virtual ~Fields() = default;

  virtual bool scalar(std::string_view key, Scalar kind, double& value, const Field& field) = 0;
  /// An array of this many numbers.
  virtual bool array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) = 0;
  virtual bool list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) = 0;
  virtual bool polygon(std::string_view key, std::vector<std::array<double, 2>>& corners,
                       const Field& field) = 0;
  virtual bool integer(std::string_view key, std::int64_t& value, const Field& field) = 0;
  virtual bool boolean(std::string_view key, bool& value, const Field& field) = 0;
  virtual bool text(std::string_view key, std::string& value, const Field& field) = 0;
  /// Different texts out of `known`, at least one; a `single` one without a list.
  virtual bool choices(std::string_view key, std::vector<std::string_view>& values,
                       std::span<const std::string_view> known, bool single, const Field& field) = 0;
  /// The name of a member of a list.
  virtual bool reference(std::string_view key, NameList list, std::uint32_t& index, const Field& field) = 0;
  /// An object with any keys and such names as values.
  virtual bool references(std::string_view key, NameList list,
                          std::vector<std::pair<std::string, std::uint32_t>>& values, const Field& field) = 0;
  virtual bool object(std::string_view key, const Part& part, const Field& field) = 0;
  /// A list of objects; `part` describes the one with an index, which may be one beyond the last.
  virtual bool objects(std::string_view key, std::size_t count,
                       const std::function<void(Fields&, std::size_t)>& part, const Field& field) = 0;
  virtual bool custom(std::string_view key, const CustomValue& value, const Field& field) = 0;

  /// Two forms of the struct. A file has the first if it has one of its `marks`.
  virtual void either(std::initializer_list<std::string_view> marks, bool is_first, const Part& first,
                      const Part& second) = 0;
  /// Exactly one of these optional keys is present.
  virtual void one_of(std::initializer_list<std::string_view> keys) = 0;
  /// At least one of these optional keys is present, because the element has no effect without them.
  virtual void any_of(std::initializer_list<std::string_view> keys) = 0;

  bool length(std::string_view key, double& value, const Field& field) {
    return scalar(key, Scalar::length, value, field);
  }
  bool plan_point(std::string_view key, std::array<double, 2>& value, const Field& field) {
    return array(key, Scalar::coordinate, value, field);
  }
  bool material(std::string_view key, MaterialId& value, const Field& field) {
    return reference(key, NameList::material, value.value, field);
  }
  bool label_type(std::string_view key, LabelTypeId& value, const Field& field) {
    return reference(key, NameList::label_type, value.value, field);
  }
};

}  // namespace shelfbeam
