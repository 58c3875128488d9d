#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// Text made safe for HTML and SVG content and quoted attributes; control characters become U+FFFD.
std::string escape(std::string_view text);

/// For CSV: nine significant digits, which preserve 32-bit values; empty for values that are not finite.
std::string csv_number(double value);

/// Replaces " %" with a non-breaking space and "%", for sentences on a page.
std::string with_joined_percent(std::string text);

/// The SI prefix for signals that suits a reference value (the requirement).
struct SignalUnit {
  Words words;
  double factor = 1;  ///< W/m^2 per unit of measure
  std::string name = "W/m²";

  std::string round_number(double signal) const { return words.plain(signal / factor); }
  std::string number(double signal) const { return words.significant(signal / factor); }
  std::string text(double signal) const { return number(signal) + "\u00A0" + name; }
};

SignalUnit signal_unit(const Words& words, double reference);

/// Joins consecutive ids to ranges, in their order: "A-1", "A-2", "A-3", "B" -> "A-1…3", "B". The ids of a
/// range differ only in the number at the end, which grows by one and has a constant number of digits.
std::vector<std::string> id_ranges(std::span<const std::string> ids);

}  // namespace shelfbeam
