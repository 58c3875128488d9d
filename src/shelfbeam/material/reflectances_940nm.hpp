#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace shelfbeam {

struct NamedReflectance {
  std::string name;
  double reflectance = 0;                      ///< diffuse, at 940 nm, in (0, 1)
  std::optional<std::array<double, 2>> range;  ///< that it may lie in, both ends included; holds it
};

/// The reflectances of data/materials_940nm.json, which says where each comes from; in its order.
const std::vector<NamedReflectance>& reflectances_940nm();

}  // namespace shelfbeam
