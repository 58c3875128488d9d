#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/reach_curve.hpp"
#include "shelfbeam/placement/coverage/budget.hpp"

namespace shelfbeam {

/// placement.json as docs/formats/placement.md describes it; the same answer gives the same text, but for
/// `seconds`. The curve is left out where there is none.
std::string placement_json(const Placement& placement, const SignalTable& table,
                           const ReachCurve& curve = {});

/// The answer of `reach_most`.
std::string reach_json(const Reach& reach, const SignalTable& table);

/// So many ids of labels at most stand in one list of critical or missed labels; their number is told.
inline constexpr std::size_t most_listed_labels = 1000;

/// Reads a placement.json against the table it belongs to, without what only a plan has (plan_file.hpp).
/// Throws InputError with file and place; an id that the table does not have is one.
Placement read_placement(const std::filesystem::path& path, const SignalTable& table);

}  // namespace shelfbeam
