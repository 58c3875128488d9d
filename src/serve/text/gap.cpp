#include "serve/text/gap.hpp"

#include <algorithm>

namespace shelfbeam::serve {

namespace {

using Kind = GapPart::Kind;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

bool is_line_end(char c) {
  return c == '\r' || c == '\n';
}

// The part that begins at `at`; empty for the character of a token.
GapPart part_at(std::string_view text, std::size_t at) {
  const auto part = [&](Kind kind, std::size_t end) {
    return GapPart{kind, text.substr(at, std::min(end, text.size()) - at)};
  };
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("\r\n")) return part(Kind::line_end, at + 2);
  if (!rest.empty() && is_line_end(rest.front())) return part(Kind::line_end, at + 1);
  if (rest.starts_with("//")) return part(Kind::line_comment, text.find_first_of("\r\n", at));
  if (rest.starts_with("/*")) {
    const std::size_t end = text.find("*/", at + 2);
    return part(Kind::block_comment, end == std::string_view::npos ? end : end + 2);
  }
  return part(Kind::blanks, text.find_first_not_of(" \t", at));
}

}  // namespace

std::vector<GapPart> parts_of(std::string_view gap) {
  std::vector<GapPart> parts;
  for (std::size_t at = 0; at < gap.size(); at += parts.back().text.size()) {
    parts.push_back(part_at(gap, at));
    if (parts.back().text.empty()) parts.back().text = gap.substr(at, 1);
  }
  return parts;
}

std::size_t gap_end(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    const std::size_t size = part_at(text, at).text.size();
    if (size == 0) break;
    at += size;
  }
  return at;
}

std::string_view first_line(std::string_view gap) {
  std::size_t size = 0;
  for (const GapPart& part : parts_of(gap)) {
    if (part.kind == Kind::line_end) break;
    size += part.text.size();
  }
  return gap.substr(0, size);
}

bool has_line_end(std::string_view gap) {
  return first_line(gap).size() < gap.size();
}

bool has_comment(std::string_view gap) {
  return gap.find('/') != std::string_view::npos;
}

bool ends_in_line_comment(std::string_view gap) {
  if (!has_comment(gap)) return false;
  return parts_of(gap).back().kind == Kind::line_comment;
}

std::string_view indentation(std::string_view gap) {
  std::size_t at = 0, line = 0;
  for (const GapPart& part : parts_of(gap)) {
    at += part.text.size();
    if (part.kind == Kind::line_end) line = at;
  }
  return gap.substr(line, leading_blanks(gap.substr(line)));
}

std::size_t comments_end(std::string_view gap) {
  std::size_t at = 0, end = 0;
  for (const GapPart& part : parts_of(gap)) {
    at += part.text.size();
    if (part.kind == Kind::line_comment || part.kind == Kind::block_comment) end = at;
  }
  return end;
}

std::size_t leading_blanks(std::string_view gap) {
  return static_cast<std::size_t>(std::find_if_not(gap.begin(), gap.end(), is_blank) - gap.begin());
}

std::size_t own_lines(std::string_view gap) {
  const std::vector<GapPart> parts = parts_of(gap);
  std::size_t at = gap.size(), begin = gap.size();
  bool is_last_line = true, line_has_comment = false;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    at -= part->text.size();
    if (part->kind == Kind::line_end) {
      if (!is_last_line && !line_has_comment) break;
      begin = at;
      is_last_line = line_has_comment = false;
    } else if (part->kind != Kind::blanks) {
      line_has_comment = true;
    }
  }
  return begin;
}

}  // namespace shelfbeam::serve
