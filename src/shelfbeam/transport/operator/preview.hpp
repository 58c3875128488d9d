#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// Reasons why a signal may be wrong by more than its error.
enum class Doubt : std::uint8_t {
  near_surface = 1,  ///< the unit is within a hand's breadth of a surface
  mirrors = 2,       ///< much of the light meets mirrors, metal or clear glass
  unexplored = 4,    ///< the unit lights surfaces that no walk has met
  skewed = 8,        ///< of a refinement: few batches give most of the spread (PowerSums)
  narrow = 16        ///< most rays of the label meet surfaces with less space before them than cells are wide
};
template <>
inline constexpr auto names_of<Doubt> = std::to_array<Named<Doubt>>({{"near_surface", Doubt::near_surface},
                                                                     {"mirrors", Doubt::mirrors},
                                                                     {"unexplored", Doubt::unexplored},
                                                                     {"skewed", Doubt::skewed},
                                                                     {"narrow", Doubt::narrow}});

/// The signals of all labels from one unit, in the signal's unit of measure: an approximation with a standard
/// error per label, never a result.
struct Preview {
  std::vector<float> signal;
  std::vector<float> direct;  ///< the part without a reflection; exact between points
  std::vector<float> error;   ///< standard error; 95 % of the truths are within 1.96 errors
  std::vector<std::uint8_t> doubts;

  bool has_doubt(std::size_t label, Doubt doubt) const {
    return (doubts[label] & static_cast<std::uint8_t>(doubt)) != 0;
  }
};

}  // namespace shelfbeam
