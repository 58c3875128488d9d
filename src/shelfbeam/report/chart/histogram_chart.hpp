#pragma once

#include <string>
#include <vector>

namespace shelfbeam {

/// A histogram to draw. Positions are in the coordinate of the horizontal axis (for a log axis: log10).
struct HistogramChart {
  struct Bar {
    double from = 0, to = 0;
    double height = 0;
    std::string css_class;
    std::string title;  ///< tooltip
  };
  struct Tick {
    double at = 0;
    std::string text;
  };
  std::string description;
  std::vector<Bar> bars;
  std::vector<Tick> ticks;
  std::vector<Tick> lines;  ///< marked values, e.g. the requirement
  std::string x_title, y_title;
};

std::string histogram_svg(const HistogramChart& chart);

}  // namespace shelfbeam
