#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/device/photometry/photometric_lines.hpp"
#include "shelfbeam/device/photometry/planes.hpp"

namespace shelfbeam::detail {

/// The content of an LM-63 file, before symmetries are unfolded.
struct IesData {
  enum class Type { c = 1, b = 2 };
  Type type = Type::c;
  std::vector<double> vertical;  ///< degrees, ascending
  std::vector<Plane> planes;  ///< horizontal angles in degrees, ascending; values in cd, all factors applied
  std::size_t vertical_line = 0, horizontal_line = 0;  ///< line numbers of the angles
};

/// Throws InputError for anything but a complete file of type C or B.
IesData read_ies_data(PhotometricLines& lines);

}  // namespace shelfbeam::detail
