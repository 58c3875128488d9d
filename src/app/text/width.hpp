#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace shelfbeam::app {

/// The columns that a text takes on a terminal: two for wide characters, none for combining marks.
std::size_t width_of(std::string_view text);

/// The text in at most `columns` columns, cut between characters and then ending with "..." where that fits.
/// Control characters and bytes that are not UTF-8 become '?'.
std::string fitted(std::string_view text, std::size_t columns);

}  // namespace shelfbeam::app
