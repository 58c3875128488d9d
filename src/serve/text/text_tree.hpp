#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/text/splice.hpp"

namespace shelfbeam::serve {

struct TextElements;

/// A value of a JSON text. The parts of an object or a list are known once it has been opened, so that an
/// edit costs one pass over the containers around it.
struct TextNode {
  std::string_view text;                   ///< as it was before any change of its parts
  std::unique_ptr<TextElements> elements;  ///< of an opened object or list
};

/// An element of a list, or a member of an object.
struct TextElement {
  std::string_view before;  ///< the gap before it
  std::string_view name;    ///< of a member, with the colon and the gaps around that
  TextNode value;
  std::string_view tail;  ///< a gap and the comma; empty if no comma follows

  bool begins_line() const;
  /// In bytes, without the gap before it.
  std::size_t size() const;
};

struct TextElements {
  std::vector<TextElement> list;
  std::string_view end;  ///< the gap before the closing bracket
};

/// A JSON text as a tree of pieces, whose changes are replacements of bytes. Values are kept as they are
/// written, so that nothing but what is changed can change.
class TextTree {
 public:
  /// Precondition: `parse_json` reads the text, which must outlive the tree.
  explicit TextTree(std::string_view text);

  TextNode& root() { return root_; }
  /// The elements of an object or a list, in the order of the text.
  static TextElements& open(TextNode& node);
  /// Replaces a value.
  void set(TextNode& node, std::string text) { node = {keep(std::move(text)), nullptr}; }
  /// Keeps a new piece as long as the tree.
  std::string_view keep(std::string text) { return kept_.emplace_back(std::move(text)); }

  /// The changes so far, in the order of the text, without common bytes at both ends.
  std::vector<Splice> changes() const;

 private:
  std::string_view text_;
  std::size_t begin_ = 0, end_ = 0;  ///< of the value in the text
  TextNode root_;
  std::deque<std::string> kept_;
};

}  // namespace shelfbeam::serve
