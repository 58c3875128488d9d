#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

/// Text made safe for HTML and SVG content and quoted attributes; control characters become U+FFFD.
std::string escape(std::string_view text);

/// Fixed decimals with the minus sign U+2212, never "-0".
std::string fixed(double value, int decimals);

/// At least `digits` significant digits as a plain decimal; powers of ten only below 1e-4 and from 1e7 on.
std::string significant(double value, int digits = 3);

/// "+3.2 dB", two decimals at least near zero; "no signal" for minus infinity, "no requirement" for plus
/// infinity.
std::string decibels(double value, int decimals = 1);

/// Up to six significant digits without trailing zeros: for round numbers such as ticks and edges.
std::string plain(double value);

/// For CSV: nine significant digits, which preserve 32-bit values; empty for values that are not finite.
std::string csv_number(double value);

/// A share in percent: 0.166 -> "16.6 %".
std::string percent(double share, int decimals = 1);

/// Rounded so that a bound claims no more than was proven. Differences of 1e-9 of the value are errors of
/// floating point.
double rounded_down(double value, int decimals);
double rounded_up(double value, int decimals);

/// As `plain`, rounded down.
std::string plain_down(double value);

/// A confidence in percent, rounded down: 0.999 -> "99.9".
std::string confidence_text(double confidence);

/// Replaces " %" with a non-breaking space and "%", for sentences on a page.
std::string with_joined_percent(std::string text);

/// The SI prefix for signals that suits a reference value (the requirement).
struct SignalUnit {
  double factor = 1;  ///< W/m^2 per unit of measure
  std::string name = "W/m²";

  std::string round_number(double signal) const { return plain(signal / factor); }
  std::string number(double signal) const { return significant(signal / factor); }
  std::string text(double signal) const { return number(signal) + "\u00A0" + name; }
};

SignalUnit signal_unit(double reference);

/// Joins consecutive ids to ranges, in their order: "A-1", "A-2", "A-3", "B" -> "A-1…3", "B". The ids of a
/// range differ only in the number at the end, which grows by one and has a constant number of digits.
std::vector<std::string> id_ranges(std::span<const std::string> ids);

}  // namespace shelfbeam
