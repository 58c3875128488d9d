#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// A range of margins that share a mark. Classes 0 and 1 are missed labels: larger, outlined triangles that
/// are visible without colour.
struct MarginClass {
  double from;  ///< dB
  const char* key;

  std::string_view name(const Words& words) const;
};

inline constexpr std::array<MarginClass, 7> margin_classes{{{-1e300, "margin.class.far_short"},
                                                            {-3, "margin.class.short"},
                                                            {0, "margin.class.to_1"},
                                                            {1, "margin.class.to_3"},
                                                            {3, "margin.class.to_6"},
                                                            {6, "margin.class.to_10"},
                                                            {10, "margin.class.above_10"}}};

/// `met` selects the side of 0 dB for margins within the tolerance.
std::size_t margin_class(double margin_db, bool met);

/// Logarithmic classes of signals with edges 1, 2, 5 times powers of ten.
struct SignalScale {
  std::vector<double> edges;  ///< ascending; class k begins at edges[k], class 0 includes smaller signals

  /// Covers the positive values from their 5 % quantile up, so that a few small signals do not use up most
  /// colours; at most `max_classes` classes down from the largest.
  explicit SignalScale(const std::vector<double>& values, std::size_t max_classes = 12);
  std::size_t classes() const { return edges.size() - 1; }
  std::size_t class_of(double signal) const;
};

/// The viridis colour map at t in [0, 1] as "#rrggbb". Lightness increases with t, also for colour-blind
/// readers.
std::string viridis(double t);

/// <g id="m0"> ... for margin classes, <g id="g0"> ... and "gz" (no signal) for signal classes.
void define_margin_marks(SvgCanvas& canvas, double radius);
/// <g id="hollow">, drawn on top of a label's mark, and "hollow-key", the mark in the legend.
void define_hollow_mark(SvgCanvas& canvas, double radius);
void define_signal_marks(SvgCanvas& canvas, const SignalScale& scale, double radius);

/// CSS variables --g0.. : strong signals are dark on paper and bright on a dark screen.
std::string signal_colours(const SignalScale& scale, bool dark);

}  // namespace shelfbeam
