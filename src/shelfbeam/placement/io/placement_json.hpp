#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>

#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/io/record.hpp"

// The parts of placement.json; each function describes the keys of one.
namespace shelfbeam::detail {

/// The version of placement.json, and the oldest that is read.
inline constexpr int format_version = 2, oldest_format = 1;

/// Throws InputError for other versions, and as JsonCursor.
JsonCursor parse_placement(const std::filesystem::path& path);

/// A plan extends this object.
void describe(Record& record, Placement& placement);
/// Without points, the keys of the curve are omitted. `selected` is not stored.
void describe(Record& record, CoverageCurve& curve);
void describe(Record& record, Price& price);

/// The ids of at most `max_listed_labels` labels.
inline Json first_ids(std::span<const LabelId> labels, const Ids& ids) {
  return ids.list(labels.first(std::min(labels.size(), max_listed_labels)));
}
/// The name of a back end; null without.
inline Json backend_of(const SolvedBy& solver) {
  return solver.backend ? Json(*solver.backend) : Json(nullptr);
}

/// The text of a file.
inline std::string file_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace shelfbeam::detail
