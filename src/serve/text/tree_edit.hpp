#pragma once

#include <cstddef>
#include <string>

#include "serve/text/layout.hpp"
#include "serve/text/text_tree.hpp"

namespace shelfbeam::serve {

/// Where the text of a new element goes.
struct Insertion {
  std::size_t index;        ///< of the element before which it is inserted, or their number
  std::string key;          ///< in objects only
  std::string indentation;  ///< of the line on which the object or the list begins
};

/// Inserts an element in the layout of its neighbours. It comes behind a comment on the line of the element
/// before, and before the comments above the element behind.
void insert(TextTree& tree, TextNode& node, const Insertion& insertion, const Json& value,
            const Layout& layout);

/// Removes an element with its comma. If it has lines of its own, the comments on these lines and on those
/// directly above go, too; if it shares a line, the comments between it and the commas around it.
void remove(TextTree& tree, TextNode& node, std::size_t index, const Layout& layout);

}  // namespace shelfbeam::serve
