#pragma once

#include <string>
#include <vector>

namespace shelfbeam {

/// Horizontal bars about a middle, one below the other: what a value becomes when one thing after the other
/// is at the low and at the high end of its range.
struct TornadoChart {
  struct Bar {
    std::string name;
    double low = 0, high = 0;
    std::string title;  ///< tooltip
  };
  std::string description;
  std::vector<Bar> bars;
  double middle = 0;
  double limit = 0;  ///< a marked value
  std::string middle_text, limit_text;
  std::string x_title;
};

std::string tornado_svg(const TornadoChart& chart);

}  // namespace shelfbeam
