#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// What hangs on one chosen unit.
struct Critical {
  std::uint32_t unit = 0;
  std::vector<std::uint32_t> labels;  ///< met, and not without it: ascending
};

/// For every unit of a selection, in its order, the labels that would be missed were it to fail alone. Where
/// units do not cooperate these are the labels that only it reaches; an answer that survives any failure has
/// none.
std::vector<Critical> critical_units(const SignalTable& table, const Question& question,
                                     const std::vector<std::uint32_t>& selected);

}  // namespace shelfbeam
