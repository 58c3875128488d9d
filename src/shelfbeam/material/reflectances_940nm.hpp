#pragma once

#include <string>
#include <vector>

namespace shelfbeam {

struct NamedReflectance {
  std::string name;
  double reflectance = 0;  ///< diffuse, at 940 nm, in (0, 1)
};

/// The reflectances of data/materials_940nm.json, which says where each comes from; in its order.
const std::vector<NamedReflectance>& reflectances_940nm();

}  // namespace shelfbeam
