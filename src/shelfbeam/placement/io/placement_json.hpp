#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/alternatives.hpp"
#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"

// Helpers shared by the parts of placement.json.
namespace shelfbeam::detail {

using Json = nlohmann::ordered_json;

/// Infinite and undefined numbers become null.
inline Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
inline double number_or_infinity(const JsonCursor& cursor) {
  return cursor.is_null() ? std::numeric_limits<double>::infinity() : cursor.non_negative();
}

using Positions = std::unordered_map<std::string_view, std::uint32_t>;

template <class Items>
Positions positions(const Items& items) {
  Positions result;
  for (const auto& item : items) result.emplace(item.id, static_cast<std::uint32_t>(result.size()));
  return result;
}

inline std::uint32_t position(const JsonCursor& cursor, const Positions& known, std::string_view what) {
  const std::string id = cursor.text();
  const auto found = known.find(id);
  if (found == known.end())
    cursor.fail(fmt::format("names {}, but the matrix has no such {}", in_quotes(id), what),
                "use the matrix that this placement was computed from");
  return found->second;
}

/// The ids of the items with these numbers.
template <class Items>
Json ids_of(const Items& items, std::span<const std::uint32_t> numbers) {
  Json ids = Json::array();
  for (const std::uint32_t k : numbers) ids.push_back(items[k].id);
  return ids;
}

/// The ids of at most `max_listed_labels` labels.
inline Json first_ids(std::span<const std::uint32_t> labels, const SignalTable& table) {
  return ids_of(table.labels, labels.first(std::min(labels.size(), max_listed_labels)));
}

/// The version of placement.json, and the oldest that is read.
inline constexpr int format_version = 2, oldest_format = 1;
/// The name of a back end; null without.
Json backend_of(const SolvedBy& solver);
/// The object of placement.json, which a plan extends. A curve without points is omitted.
Json placement_object(const Placement& placement, const SignalTable& table, const CoverageCurve& curve);
Placement read_placement(const JsonCursor& file, const SignalTable& table);
/// The curve without `selected`; without points if the file has no curve.
CoverageCurve read_curve(const JsonCursor& file, const SignalTable& table);

/// Prices; null without.
Json price_object(const std::optional<Price>& price);
std::optional<Price> read_price(const JsonCursor& json);

Json alternatives_object(const Alternatives& alternatives, const SignalTable& table);
Alternatives read_alternatives(const JsonCursor& json, const SignalTable& table);

/// The text of a file.
inline std::string file_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace shelfbeam::detail
