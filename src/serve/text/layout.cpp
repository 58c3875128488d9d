#include "serve/text/layout.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "serve/text/gap.hpp"
#include "serve/text/token.hpp"

namespace shelfbeam::serve {

namespace {

constexpr std::size_t line_width = 120;

// The blanks of a gap within a line, reduced to one: more of them align columns.
std::optional<std::string> blank_in(std::string_view gap) {
  if (has_line_end(gap) || has_comment(gap)) return std::nullopt;
  return gap.empty() ? "" : " ";
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

// `text_of` returns the text of a part.
template <class TextOf>
std::vector<std::string> part_texts(const Json& value, const Layout& layout, const TextOf& text_of) {
  std::vector<std::string> texts;
  for (auto part = value.begin(); part != value.end(); ++part)
    texts.push_back(value.is_object() ? text_of(Json(part.key()).dump() + layout.colon, *part)
                                      : text_of("", *part));
  return texts;
}

std::string one_line(const Json& value, const Layout& layout) {
  if (!value.is_structured()) return scalar_text(value);
  const auto texts = part_texts(value, layout, [&](const std::string& name, const Json& part) {
    return name + one_line(part, layout);
  });
  const std::string inside = joined(texts, layout.comma);
  if (value.is_array()) return '[' + inside + ']';
  return texts.empty() ? "{}" : '{' + layout.brace + inside + layout.brace + '}';
}

// Puts as many parts on a line as it has room for, behind `begin` except on the first, which has `room` left.
std::string filled(const std::vector<std::string>& parts, const Layout& layout, const std::string& begin,
                   std::size_t room) {
  const std::size_t full = line_width - std::min(line_width, begin.size());
  std::string text;
  std::size_t used = 0;
  for (const std::string& part : parts) {
    if (!text.empty() && used + layout.comma.size() + part.size() + 1 > room) {
      text += ',' + begin;
      used = 0;
      room = full;
    } else if (!text.empty()) {
      text += layout.comma;
      used += layout.comma.size();
    }
    text += part;
    const std::size_t last = part.rfind('\n');
    used = last == std::string::npos ? used + part.size() : part.size() - last;
  }
  return text;
}

}  // namespace

Layout layout_of(std::string_view text) {
  Layout layout;
  std::optional<std::string> indent, brace, colon, comma;
  const std::size_t line_end = text.find_first_of("\r\n");
  if (line_end != std::string_view::npos)
    layout.line_end = text.substr(line_end, text.substr(line_end).starts_with("\r\n") ? 2 : 1);
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"') {
      at = quoted_end(text, at);
      continue;
    }
    const std::size_t begin = c == '{' || c == '[' || c == ':' || c == ',' ? at + 1 : at;
    const std::size_t end = gap_end(text, begin);
    const std::string_view gap = text.substr(begin, end - begin);
    if (begin > at) {
      if ((c == '{' || c == '[') && !indent && has_line_end(gap) && !indentation(gap).empty())
        indent = indentation(gap);
      if (c == '{' && !brace && !text.substr(end).starts_with('}')) brace = blank_in(gap);
      if (c == ':' && !colon) colon = blank_in(gap);
      if (c == ',' && !comma) comma = blank_in(gap);
    }
    if (indent && brace && colon && comma) break;
    at = std::max(end, at + 1);
  }
  if (line_end == std::string_view::npos && (colon || comma)) layout.line_end.clear();
  layout.indent = indent.value_or(layout.indent);
  layout.brace = brace.value_or(colon.value_or(layout.brace));
  if (colon) layout.colon = ':' + *colon;
  if (const auto blank = comma ? comma : colon) layout.comma = ',' + *blank;
  return layout;
}

bool deserves_lines(const Json& value) {
  return value.is_object() ||
         (value.is_array() &&
          std::any_of(value.begin(), value.end(), [](const Json& part) { return part.is_structured(); }));
}

std::size_t room_behind(std::size_t used, std::string_view neighbour) {
  if (neighbour.size() > line_width && neighbour.find_first_of("\r\n") == std::string_view::npos)
    return std::string_view::npos;
  return line_width - std::min(line_width, used);
}

bool fills_lines(std::string_view text) {
  if (!text.starts_with('{') && !text.starts_with('[')) return false;
  return !has_line_end(text.substr(1, gap_end(text, 1) - 1));
}

std::string value_text(const Json& value, const Layout& layout, const std::string& indentation,
                       std::size_t room, bool fills) {
  std::string line = one_line(value, layout);
  if (!value.is_structured() || value.empty() || layout.line_end.empty() || line.size() <= room) return line;
  const std::string inner = indentation + layout.indent, begin = layout.line_end + inner;
  const auto texts = part_texts(value, layout, [&](const std::string& name, const Json& part) {
    return name + value_text(part, layout, inner, room_behind(inner.size() + name.size() + 1), fills);
  });
  const bool is_list = value.is_array();
  if (fills) {
    const std::string blank = is_list ? "" : layout.brace;
    return (is_list ? '[' : '{') + blank +
           filled(texts, layout, begin, room - std::min(room, 2 * (1 + blank.size()))) + blank +
           (is_list ? ']' : '}');
  }
  return (is_list ? '[' : '{') + begin + joined(texts, ',' + begin) + layout.line_end + indentation +
         (is_list ? ']' : '}');
}

}  // namespace shelfbeam::serve
