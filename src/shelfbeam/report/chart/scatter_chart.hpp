#pragma once

#include <string>
#include <vector>

namespace shelfbeam {

/// Points on two logarithmic axes of equal scale, and the line on which both are equal.
struct ScatterChart {
  enum class Mark { usual, faint, outlier };
  struct Dot {
    double x = 0, y = 0;              ///< above 0
    double x_error = 0, y_error = 0;  ///< standard errors; bars where they are above 0
    Mark mark = Mark::usual;
    std::string title;  ///< tooltip
  };
  std::string description;
  std::vector<Dot> dots;  ///< usual and faint ones that would cover one another are drawn once
  double band_db = 0;     ///< dashed lines so far on both sides of equality; 0: none
  std::string x_title, y_title;
};

std::string scatter_svg(const ScatterChart& chart);

/// The marks with what they mean, as a list; only those that occur.
std::string scatter_legend(const ScatterChart& chart);

}  // namespace shelfbeam
