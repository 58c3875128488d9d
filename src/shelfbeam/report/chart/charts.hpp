#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/text/words.hpp"

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

std::string histogram_svg(const Words& words, const HistogramChart& chart);

/// Lower and upper bounds of a value over a count, from 0 to 100 %.
struct CurveChart {
  struct Point {
    double x = 0, low = 0, high = 0;
    std::string title;  ///< tooltip
  };
  std::string description;
  std::vector<Point> points;  ///< x ascends
  std::string x_title, y_title;
};

std::string curve_svg(const Words& words, const CurveChart& chart);

/// Horizontal bars about a middle value, one per input: the value with that input at the low and at the high
/// end of its range.
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

std::string tornado_svg(const Words& words, const TornadoChart& chart);

/// Points on two logarithmic axes of equal scale, and the line of equality.
struct ScatterChart {
  enum class Mark { usual, faint, outlier };
  struct Dot {
    double x = 0, y = 0;              ///< above 0
    double x_error = 0, y_error = 0;  ///< standard errors; bars where they are above 0
    Mark mark = Mark::usual;
    std::string title;  ///< tooltip
  };
  std::string description;
  std::vector<Dot> dots;  ///< usual and faint dots at nearly the same point are drawn once
  double band_db = 0;     ///< distance of dashed lines on both sides of equality; 0: none
  std::string x_title, y_title;
};

std::string scatter_svg(const Words& words, const ScatterChart& chart);

/// The marks and their meanings as a list; only marks that occur.
std::string scatter_legend(const Words& words, const ScatterChart& chart);

}  // namespace shelfbeam
