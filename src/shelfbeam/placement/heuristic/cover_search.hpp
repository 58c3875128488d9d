#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam::detail {

/// Whether `cover_search` takes this question: the fewest units (lexicographic), each label reached by one,
/// and no candidates that exclude one another.
bool is_plain_cover(const SignalTable& table, const Question& question);

/// A selection of fewer units than `start`, which meets every label, by a search for set covering with
/// weights on rows (Gao and others, Engineering Applications of Artificial Intelligence 38, 2015), on what
/// `reduction` (of the number of units) leaves. A move costs what its columns reach and not a scan of the
/// matrix. Walks begin with `seed` and those that follow. Nothing where none was found.
std::optional<std::vector<std::uint32_t>> cover_search(const SignalTable& table, const Question& question,
                                                       const Reduction& reduction,
                                                       const std::vector<std::uint32_t>& start,
                                                       const Effort& effort, std::uint32_t seed,
                                                       const RunControl& control);

}  // namespace shelfbeam::detail
