#include "serve/text/tree_edit.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "serve/text/gap.hpp"

namespace shelfbeam::serve {

namespace {

// A gap with a new element in it.
struct Divided {
  std::string_view kept;     ///< stays on the line of the element or the bracket before
  std::string lead;          ///< the new gap before the element
  std::string_view rest;     ///< the rest of the old gap, behind the element and its comma
  std::string closing = {};  ///< a new gap behind the element, before that rest
};

struct Words {
  const Layout& layout;
  std::string blank() const { return layout.comma.substr(1); }
  std::string line(std::string_view indentation) const { return layout.line_end + std::string(indentation); }
};

Divided divide_empty(std::string_view gap, bool is_object, const Insertion& place, const Json& value,
                     const Layout& layout) {
  const Words words{layout};
  const std::string inner = std::string(indentation(gap)) + layout.indent;
  if (has_line_end(gap)) {
    const std::string_view kept = first_line(gap);
    return {kept, words.line(inner), gap.substr(kept.size())};
  }
  const std::string_view kept = gap.substr(0, comments_end(gap));
  if (deserves_lines(value) && !layout.line_end.empty())
    return {kept, words.line(place.indentation + layout.indent), {}, words.line(place.indentation)};
  const std::string blank = is_object ? layout.brace : "";
  return {kept, kept.empty() ? blank : " ", {}, blank};
}

Divided divide_before(std::string_view gap, bool is_first, const Layout& layout) {
  const Words words{layout};
  if (has_line_end(gap)) {
    const std::string_view kept = first_line(gap);
    return {kept, words.line(indentation(gap)), gap.substr(kept.size())};
  }
  const std::size_t blanks = leading_blanks(gap);
  return {{},
          is_first ? std::string(gap.substr(0, blanks)) : words.blank(),
          gap,
          blanks == 0 ? words.blank() : ""};
}

// The indentation of the last line that begins with an element.
std::optional<std::string> sibling_indentation(const TextElements& parts) {
  const auto found = std::find_if(parts.list.rbegin(), parts.list.rend(),
                                  [](const TextElement& e) { return e.begins_line(); });
  if (found == parts.list.rend()) return std::nullopt;
  return std::string(indentation(found->before));
}

// The length of the last line, if it begins with an element.
std::size_t last_line_length(const TextElements& parts) {
  std::size_t length = 0;
  for (auto element = parts.list.rbegin(); element != parts.list.rend(); ++element) {
    length += element->size();
    if (element->begins_line()) return length + indentation(element->before).size();
    length += element->before.size();
  }
  return 0;
}

Divided divide_end(const TextElements& parts, const Insertion& place, std::size_t added,
                   const Layout& layout) {
  const Words words{layout};
  const std::string_view gap = parts.end;
  const bool breaks = has_line_end(gap);
  const std::string_view kept = breaks ? first_line(gap) : gap.substr(0, comments_end(gap));
  const bool has_own_line = parts.list.back().begins_line() || (breaks && has_comment(kept)) ||
                            added > room_behind(last_line_length(parts) + layout.comma.size());
  if (!has_own_line) return {kept, words.blank(), gap.substr(kept.size())};
  const std::string around = breaks ? std::string(indentation(gap)) : place.indentation;
  return {kept, words.line(sibling_indentation(parts).value_or(around + layout.indent)),
          gap.substr(kept.size())};
}

}  // namespace

void insert(TextTree& tree, TextNode& node, const Insertion& place, const Json& value, const Layout& layout) {
  TextElements& parts = TextTree::open(node);
  const bool is_object = node.text.front() == '{', is_end = place.index == parts.list.size();
  std::string_view& gap = is_end ? parts.end : parts.list[place.index].before;
  const std::string name = is_object ? Json(place.key).dump() + layout.colon : "";
  const std::size_t length = name.size() + value_text(value, layout, "", std::string::npos).size();
  Divided divided = parts.list.empty() ? divide_empty(gap, is_object, place, value, layout)
                    : is_end           ? divide_end(parts, place, length, layout)
                                       : divide_before(gap, place.index == 0, layout);

  TextElement element;
  if (!is_end) element.tail = tree.keep(",");
  if (is_end && !parts.list.empty()) {
    std::string_view& tail = parts.list.back().tail;
    if (!tail.empty()) {
      element.tail = tree.keep(",");
    } else if (!has_line_end(gap) && has_comment(divided.kept)) {
      // `1 /* one */` becomes `1 /* one */, 2`.
      tail = tree.keep(std::string(std::exchange(divided.kept, {})) + ',');
    } else {
      tail = tree.keep(",");
    }
  }
  const bool has_own_line = has_line_end(divided.lead);
  const std::string indent = has_own_line ? std::string(indentation(divided.lead)) : place.indentation;
  element.before = tree.keep(std::string(divided.kept) + divided.lead);
  element.name = tree.keep(name);
  const std::string_view neighbour = parts.list.empty()
                                         ? std::string_view()
                                         : parts.list[place.index - (place.index > 0 ? 1 : 0)].value.text;
  element.value.text = tree.keep(
      value_text(value, layout, indent,
                 room_behind(has_own_line ? indent.size() + name.size() + 1 : name.size(), neighbour),
                 fills_lines(neighbour)));
  gap = divided.closing.empty() ? divided.rest : tree.keep(divided.closing + std::string(divided.rest));
  parts.list.insert(parts.list.begin() + static_cast<std::ptrdiff_t>(place.index), std::move(element));
}

void remove(TextTree& tree, TextNode& node, std::size_t index, const Layout& layout) {
  TextElements& parts = TextTree::open(node);
  const TextElement& element = parts.list[index];
  const bool is_first = index == 0, is_last = index + 1 == parts.list.size();
  std::string_view& gap = is_last ? parts.end : parts.list[index + 1].before;
  const std::string_view before = element.before;
  const bool begins = element.begins_line(), breaks = has_line_end(gap);

  std::string remaining;
  std::string_view behind;
  if ((is_first || begins) && (is_last || breaks)) {  // alone on its lines
    remaining = before.substr(0, begins ? own_lines(before) : leading_blanks(before));
    behind = gap.substr(breaks ? first_line(gap).size() : comments_end(gap));
  } else if (is_first || begins) {
    const std::string_view blanks = begins ? indentation(before) : before.substr(0, leading_blanks(before));
    remaining = before.substr(0, static_cast<std::size_t>(blanks.data() - before.data()) + blanks.size());
    behind = gap.substr(leading_blanks(gap));
  } else {
    behind = is_last && !breaks ? gap.substr(comments_end(gap)) : gap;
  }

  if (!element.tail.empty()) {
    // Where lines begin with commas, comments before the comma are about what follows.
    const std::string_view tail = element.tail.substr(0, element.tail.size() - 1);
    const std::string_view lines = tail.substr(first_line(tail).size());
    if (has_comment(lines)) remaining += lines;
  } else if (!is_first) {
    std::string_view& tail = parts.list[index - 1].tail;
    remaining.insert(0, tail.substr(0, tail.size() - 1));
    tail = {};
  }
  if (ends_in_line_comment(remaining) && (behind.empty() || !first_line(behind).empty())) {
    remaining += layout.line_end + std::string(indentation(before));
    behind.remove_prefix(leading_blanks(behind));
  }
  remaining += behind;
  if (parts.list.size() == 1 && !has_comment(remaining)) remaining.clear();
  gap = tree.keep(std::move(remaining));
  parts.list.erase(parts.list.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace shelfbeam::serve
