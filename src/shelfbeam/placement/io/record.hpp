#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::detail {

using Json = nlohmann::ordered_json;

/// Infinite and undefined numbers become null.
Json number(double value);

/// The ids of a list, by which files name its members.
class Ids {
 public:
  /// `what` they name, for errors.
  template <class Items>
  Ids(const Items& items, std::string_view what) : what_(what) {
    for (const auto& item : items) {
      positions_.emplace(item.id, static_cast<std::uint32_t>(ids_.size()));
      ids_.emplace_back(item.id);
    }
  }

  std::size_t size() const { return ids_.size(); }
  std::string_view operator[](std::uint32_t position) const { return ids_[position]; }
  template <class Positions>
  Json list(const Positions& positions) const {
    Json list = Json::array();
    for (const auto position : positions) list.push_back(ids_[position]);
    return list;
  }
  /// Throws InputError for other ids, as the functions below.
  std::uint32_t position(const JsonCursor& id) const { return position(id.text(), id); }
  /// That of the key of a member.
  std::uint32_t position(const std::string& id, const JsonCursor& member) const;
  template <class Position>
  std::vector<Position> positions(const JsonCursor& ids) const {
    std::vector<Position> positions;
    for (const JsonCursor& id : ids.elements()) positions.push_back(position(id));
    return positions;
  }

 private:
  std::string_view what_;
  std::vector<std::string_view> ids_;
  std::unordered_map<std::string_view, std::uint32_t> positions_;
};

/// A table and its ids.
struct TableIds {
  const SignalTable& table;
  Ids labels = {table.labels, "label"}, transceivers = {table.transceivers, "transceiver"};
};

/// An object of placement.json with the values of a struct. A function `describe` calls a member of Record
/// for each key, in the order of the file. It is called to list the keys, to write a copy of the struct, or
/// to fill an empty one. Functions `write` are called only to write.
class Record {
 public:
  /// Calls the function `describe` of the namespace of the struct.
  struct Usual {
    template <class Struct>
    void operator()(Record& record, Struct& value) const {
      describe(record, value);
    }
  };

  template <class Struct, class Describe = Usual>
  static Json write(Struct value, const TableIds& ids, const Describe& describe = {}) {
    Record record(nullptr, ids);
    record.json_ = Json::object();
    describe(record, value);
    return std::move(*record.json_);
  }
  /// Throws InputError for unknown and missing keys and unsuitable values.
  template <class Struct, class Describe = Usual>
  static Struct read(const JsonCursor& file, const TableIds& ids, const Describe& describe = {}) {
    Struct empty, value;
    Record keys(nullptr, ids), record(&file, ids);
    describe(keys, empty);
    file.expect_keys(keys.keys_);
    describe(record, value);
    return value;
  }

  const TableIds& ids() const { return ids_; }
  /// The position of the object that is read, else null.
  const JsonCursor* file() const { return file_; }

  /// The next key that is read may be missing, as in files of earlier versions; the struct then keeps its
  /// value.
  Record& later() {
    is_later_ = true;
    return *this;
  }
  /// Whether this object has a key that others lack: in a file, whether it is there; to write, `is_given`.
  bool has(std::string_view key, bool is_given) const {
    if (json_) return is_given;
    return file_ == nullptr || file_->find(key).has_value();
  }
  /// The file may have other keys, which are not read.
  void ignore(std::initializer_list<std::string_view> keys) { keys_.insert(keys_.end(), keys); }

  /// `write` returns Json; `read` takes its position.
  template <std::invocable Write, std::invocable<const JsonCursor&> Read>
  void custom(std::string_view key, const Write& write, const Read& read) {
    if (json_)
      (*json_)[key] = write();
    else if (const auto found = find(key))
      read(*found);
  }
  /// For other readers of the file.
  template <std::invocable Write>
  void note(std::string_view key, const Write& write) {
    if (json_)
      (*json_)[key] = write();
    else
      keys_.push_back(key);
  }

  /// `read` is a function of JsonCursor, or takes one.
  template <class Value, class Read>
  void value(std::string_view key, Value& value, const Read& read) {
    custom(
        key, [&] { return Json(value); },
        [&](const JsonCursor& json) { value = static_cast<Value>(std::invoke(read, json)); });
  }
  void positive(std::string_view key, double& number) { value(key, number, &JsonCursor::positive); }
  void non_negative(std::string_view key, double& number) { value(key, number, &JsonCursor::non_negative); }
  void boolean(std::string_view key, bool& is_true) { value(key, is_true, &JsonCursor::boolean); }
  void text(std::string_view key, std::string& text) { value(key, text, &JsonCursor::text); }
  void finite(std::string_view key, double& number) {
    value(key, number, [](const JsonCursor& json) { return json.number(); });
  }
  template <std::unsigned_integral Count>
  void count(std::string_view key, Count& count,
             std::int64_t most = std::numeric_limits<std::uint32_t>::max(), std::int64_t least = 0) {
    value(key, count, [=](const JsonCursor& json) { return json.integer(least, most); });
  }
  /// Null if infinite; else at least 0. `to_json` may round it.
  void number(std::string_view key, double& value, Json (*to_json)(double) = detail::number);
  template <class Enum>
  void name(std::string_view key, Enum& value) {
    custom(
        key, [&] { return Json(to_text(value)); },
        [&](const JsonCursor& json) { value = json.choice<Enum>(); });
  }
  void id(std::string_view key, LabelId& position, const Ids& ids);
  template <class Position>
  void id_list(std::string_view key, std::vector<Position>& positions, const Ids& ids) {
    custom(
        key, [&] { return ids.list(positions); },
        [&](const JsonCursor& json) { positions = ids.positions<Position>(json); });
  }
  void texts(std::string_view key, std::vector<std::string>& texts);

  template <class Struct, class Describe = Usual>
  void object(std::string_view key, Struct& value, const Describe& describe = {}) {
    custom(
        key, [&] { return write(value, ids_, describe); },
        [&](const JsonCursor& json) { value = read<Struct>(json, ids_, describe); });
  }
  /// Null without a value.
  template <class Struct, class Describe = Usual>
  void nullable(std::string_view key, std::optional<Struct>& value, const Describe& describe = {}) {
    custom(
        key, [&] { return value ? write(*value, ids_, describe) : Json(nullptr); },
        [&](const JsonCursor& json) {
          if (!json.is_null()) value = read<Struct>(json, ids_, describe);
        });
  }
  /// Without a value, the key is omitted.
  template <class Struct, class Describe = Usual>
  void optional(std::string_view key, std::optional<Struct>& value, const Describe& describe = {}) {
    if (has(key, value.has_value())) object(key, value ? *value : value.emplace(), describe);
  }
  template <class Struct, class Describe = Usual>
  void list(std::string_view key, std::vector<Struct>& values, const Describe& describe = {}) {
    const auto write_all = [&] {
      Json list = Json::array();
      for (const Struct& value : values) list.push_back(write(value, ids_, describe));
      return list;
    };
    custom(key, write_all, [&](const JsonCursor& json) {
      for (const JsonCursor& element : json.elements())
        values.push_back(read<Struct>(element, ids_, describe));
    });
  }

 private:
  Record(const JsonCursor* file, const TableIds& ids) : file_(file), ids_(ids) {}
  std::optional<JsonCursor> find(std::string_view key);

  const JsonCursor* file_;
  const TableIds& ids_;
  std::optional<Json> json_;
  std::vector<std::string_view> keys_;
  bool is_later_ = false;
};

}  // namespace shelfbeam::detail
