#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"

namespace shelfbeam {

/// placement.json as docs/formats/placement.md describes it. Equal results give equal text. A curve
/// without points is omitted.
std::string placement_json(const Placement& placement, const SignalTable& table,
                           const CoverageCurve& curve = {});

/// The result of `maximise_coverage`.
std::string coverage_json(const MaxCoverage& reach, const SignalTable& table);

/// The result of `fewest_units`.
std::string fewest_units_json(const FewestUnits& fewest, const SignalTable& table);

/// The record of a search as a list; values that do not exist yet are null.
std::string steps_json(std::span<const SearchStep> steps);

/// Maximum number of ids in a list of critical or missed labels; the file always states their number.
inline constexpr std::size_t max_listed_labels = 1000;

/// Reads a placement.json for its table, without the members of a plan (plan_file.hpp). Throws InputError
/// with file and position; an id that the table does not contain is an error.
Placement read_placement(const std::filesystem::path& path, const SignalTable& table);

/// The selection of a file of `place` or `plan` for any question, ascending. Throws InputError as
/// `read_placement` does.
Selection read_selection(const std::filesystem::path& path, const SignalTable& table);

}  // namespace shelfbeam
