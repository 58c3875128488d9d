#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam::serve {

/// A replacement of bytes of a text.
struct Splice {
  std::size_t at = 0;
  std::string before, after;  ///< the replaced bytes, and those in their place

  bool operator==(const Splice&) const = default;
};

/// The shortest replacement that turns one text into another.
Splice splice_between(std::string_view before, std::string_view after);

/// The text with the replacement. Precondition: it contains `before` at this place.
std::string spliced(std::string_view text, const Splice& splice);

/// The text with several replacements, whose places are those in the text before, in ascending order. Throws
/// std::invalid_argument if the text does not contain what they replace.
std::string spliced(std::string_view text, const std::vector<Splice>& splices);

/// The replacements that take such replacements back.
std::vector<Splice> inverse(std::vector<Splice> splices);

}  // namespace shelfbeam::serve
