#pragma once

#include <string>
#include <vector>

namespace shelfbeam {

/// A value that is known to lie between two, over a number; from 0 to 100 %.
struct CurveChart {
  struct Point {
    double x = 0, low = 0, high = 0;
    std::string title;  ///< tooltip
  };
  std::string description;
  std::vector<Point> points;  ///< x ascends
  std::string x_title, y_title;
};

std::string curve_svg(const CurveChart& chart);

}  // namespace shelfbeam
