#include "serve/text/text_tree.hpp"

#include <functional>
#include <stdexcept>
#include <utility>

#include "serve/text/gap.hpp"
#include "serve/text/token.hpp"

namespace shelfbeam::serve {

namespace {

template <class Use>
void each_piece(const TextNode& node, const Use& use) {
  if (!node.elements) {
    use(node.text);
    return;
  }
  use(node.text.substr(0, 1));
  for (const TextElement& element : node.elements->list) {
    use(element.before);
    use(element.name);
    each_piece(element.value, use);
    use(element.tail);
  }
  use(node.elements->end);
  use(node.text.substr(node.text.size() - 1));
}

// Joins the pieces that are not of the old text to replacements.
class Changes {
 public:
  Changes(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

  void add(std::string_view piece) {
    if (piece.empty()) return;
    if (!is_old(piece)) {
      added_ += piece;
      return;
    }
    const auto begin = static_cast<std::size_t>(piece.data() - text_.data());
    if (begin < at_) throw std::logic_error("the pieces of a text have changed their order");
    replace_until(begin);
    at_ = begin + piece.size();
  }

  std::vector<Splice> until(std::size_t end) {
    replace_until(end);
    return std::move(splices_);
  }

 private:
  bool is_old(std::string_view piece) const {
    const std::less<> is_before;
    return !is_before(piece.data(), text_.data()) && is_before(piece.data(), text_.data() + text_.size());
  }
  void replace_until(std::size_t end) {
    Splice splice = splice_between(text_.substr(at_, end - at_), added_);
    splice.at += at_;
    if (!splice.before.empty() || !splice.after.empty()) splices_.push_back(std::move(splice));
    added_.clear();
  }

  std::string_view text_;
  std::size_t at_;     ///< behind the last old piece
  std::string added_;  ///< behind the same piece
  std::vector<Splice> splices_;
};

}  // namespace

bool TextElement::begins_line() const {
  return has_line_end(before);
}

std::size_t TextElement::size() const {
  std::size_t size = name.size() + tail.size();
  each_piece(value, [&](std::string_view piece) { size += piece.size(); });
  return size;
}

TextTree::TextTree(std::string_view text) : text_(text) {
  // The parser accepts a second byte order mark.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  while (text.substr(begin_).starts_with(mark)) begin_ += mark.size();
  begin_ = gap_end(text, begin_);
  end_ = value_end(text, begin_);
  root_.text = text.substr(begin_, end_ - begin_);
}

TextElements& TextTree::open(TextNode& node) {
  if (node.elements) return *node.elements;
  node.elements = std::make_unique<TextElements>();
  const std::string_view text = node.text;
  std::size_t at = 1;
  const auto behind = [&](std::size_t end) {
    const std::string_view piece = text.substr(at, end - at);
    at = end;
    return piece;
  };
  std::string_view gap = behind(gap_end(text, at));
  while (at + 1 < text.size()) {
    TextElement& element = node.elements->list.emplace_back();
    element.before = gap;
    if (text.front() == '{') element.name = behind(gap_end(text, gap_end(text, quoted_end(text, at)) + 1));
    element.value.text = behind(value_end(text, at));
    gap = behind(gap_end(text, at));
    if (text[at] != ',') continue;
    const std::size_t begin = at - gap.size();
    ++at;
    element.tail = text.substr(begin, at - begin);
    gap = behind(gap_end(text, at));
  }
  node.elements->end = gap;
  return *node.elements;
}

std::vector<Splice> TextTree::changes() const {
  Changes changes(text_, begin_);
  each_piece(root_, [&](std::string_view piece) { changes.add(piece); });
  return changes.until(end_);
}

}  // namespace shelfbeam::serve
