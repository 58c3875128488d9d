#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace shelfbeam {

struct NamedReflectance {
  std::string name;
  double reflectance = 0;                      ///< diffuse, at 940 nm, in (0, 1)
  std::optional<std::array<double, 2>> range;  ///< plausible range, including `reflectance`
};

/// The reflectances of data/materials_940nm.json, in the order of that file, which cites their sources.
const std::vector<NamedReflectance>& reflectances_940nm();

}  // namespace shelfbeam
