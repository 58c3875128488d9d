#pragma once

#include <array>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The unit of the lengths in a file.
enum class LengthUnit { m, mm, cm, ft, in };
template <>
inline constexpr auto names_of<LengthUnit> = std::to_array<Named<LengthUnit>>({{"m", LengthUnit::m},
                                                                               {"mm", LengthUnit::mm},
                                                                               {"cm", LengthUnit::cm},
                                                                               {"ft", LengthUnit::ft},
                                                                               {"in", LengthUnit::in}});

/// A length in metres. A length in mm or cm becomes the double nearest to the length in metres if `length` is
/// exact, and 1 ft is exactly 0.3048 m.
constexpr double to_metres(double length, LengthUnit unit) {
  switch (unit) {
    case LengthUnit::mm:
      return length / 1000;
    case LengthUnit::cm:
      return length / 100;
    case LengthUnit::ft:
      return length * 381 / 1250;
    case LengthUnit::in:
      return length * 127 / 5000;
    case LengthUnit::m:
      break;
  }
  return length;
}

}  // namespace shelfbeam
