#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "serve/text/json_value.hpp"

namespace shelfbeam::serve {

/// How a JSON text is laid out. The defaults are those of our examples.
struct Layout {
  std::string line_end = "\n";  ///< empty if all of the text is on one line
  std::string indent = "  ";    ///< of a level
  std::string brace = " ";      ///< within the braces of an object on one line
  std::string colon = ": ";
  std::string comma = ", ";  ///< between elements on one line
};

/// The layout of a text, as its first object, colon, comma and indented line show it. Precondition: the text
/// is JSON, perhaps with comments.
Layout layout_of(std::string_view text);

/// How many bytes a value may have on a line that has `used` bytes already. Where its `neighbour` is on one
/// long line, there is no limit.
std::size_t room_behind(std::size_t used, std::string_view neighbour = {});

/// Whether the elements of an object or a list follow its bracket on the same line, so that further lines are
/// filled rather than begun for each.
bool fills_lines(std::string_view text);

/// The text of a value. It is on one line if that has room for it, or if it is a scalar; its other lines
/// begin with at least `indentation`, and with `fills` have as many elements as they have room for.
std::string value_text(const Json& value, const Layout& layout, const std::string& indentation,
                       std::size_t room, bool fills = false);

/// Whether a value is easier to read on lines of its own: an object, or a list that has lists or objects.
bool deserves_lines(const Json& value);

}  // namespace shelfbeam::serve
