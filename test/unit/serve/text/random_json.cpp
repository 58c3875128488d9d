#include "random_json.hpp"

#include <array>

namespace shelfbeam::serve {

namespace {

enum : std::size_t { minified, one_line, lines, disorder, layouts };

const std::array<std::string, 12> keys{"a", "b", "type", "at", "~", "/", "", "0", "x y", "\"q\"", "ü", "//"};

}  // namespace

std::string RandomJson::key() {
  return keys[below(keys.size())];
}

Json RandomJson::value(std::size_t levels) {
  switch (below(levels == 0 ? 6 : 9)) {
    case 0:
      return static_cast<double>(below(100'000)) / 100;
    case 1:
      return static_cast<std::int64_t>(below(2000)) - 1000;
    case 2:
      return key() + "]}, // no comment";
    case 3:
      return below(2) == 0;
    case 4:
      return nullptr;
    case 5:
      return std::ldexp(static_cast<double>(random_()), static_cast<int>(below(200)) - 100);
    case 6:
    case 7: {
      Json object = Json::object();
      for (std::size_t k = below(6); k > 0; --k) object[key()] = value(levels - 1);
      return object;
    }
    default: {
      Json list = Json::array();
      for (std::size_t k = below(6); k > 0; --k) list.push_back(value(levels - 1));
      return list;
    }
  }
}

std::string RandomJson::gap() {
  static const std::array<std::string, 5> blanks{"", "", " ", "\t", "  "};
  std::string gap = blanks[below(blanks.size())];
  if (below(3) > 0) return gap;
  for (std::size_t parts = below(4); parts > 0; --parts) {
    static const std::array<std::string, 4> comments{"/* ] \" */", "/**/", "// }, \"", "//"};
    const std::string& comment = comments[below(comments.size())];
    gap += comment + (comment.starts_with("//") ? line_end_ : "") + blanks[below(blanks.size())];
    if (below(3) == 0) gap += line_end_ + blanks[below(blanks.size())];
  }
  return gap;
}

std::string RandomJson::line_gap() {
  static const std::array<std::string, 4> ends{"", "", " // on the line", " /* on the line */"};
  std::string gap = ends[below(ends.size())];
  if (below(6) == 0) gap += line_end_;
  if (below(4) == 0) gap += line_end_ + "  // above";
  return gap + line_end_;
}

void RandomJson::write(const Json& value, std::size_t level, std::string& text) {
  const auto add_gap = [&] {
    if (layout_ == disorder) text += gap();
  };
  const auto add_line = [&](std::size_t depth) {
    if (layout_ == lines && below(8) > 0) text += line_gap() + std::string(2 * depth, ' ');
    if (layout_ == one_line) text += ' ';
    add_gap();
  };
  if (!value.is_structured()) {
    text += value.dump();
    return;
  }
  text += value.is_object() ? '{' : '[';
  if (layout_ != one_line || value.is_object()) add_line(level + 1);
  std::size_t left = value.size();
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (value.is_object()) {
      text += Json(part.key()).dump();
      add_gap();
      text += layout_ == minified ? ":" : ": ";
      add_gap();
    }
    write(*part, level + 1, text);
    add_gap();
    if (--left == 0) break;
    text += ',';
    add_line(level + 1);
  }
  if (layout_ >= lines && !value.empty() && below(4) == 0) text += ',';
  if (layout_ != one_line || value.is_object()) add_line(level);
  text += value.is_object() ? '}' : ']';
}

std::string RandomJson::text(const Json& value) {
  static const std::array<std::string, 4> line_ends{"\n", "\n", "\r\n", "\r"};
  layout_ = below(layouts);
  line_end_ = line_ends[below(line_ends.size())];
  std::string text = below(4) == 0 ? "\xEF\xBB\xBF" : "";
  if (layout_ >= lines) text += "// first " + line_end_;
  write(value, 0, text);
  if (layout_ >= lines) text += gap() + "// last";
  return text;
}

EditOp RandomJson::op(const Json& root) {
  EditOp op;
  const Json* at = &root;
  // Half of the steps end at a part that is a leaf, or at a new place.
  while (at->is_structured()) {
    if (below(4) == 0) {
      const std::string name = at->is_object() ? key() : "";
      if (at->is_object() && at->contains(name)) continue;
      Json::json_pointer pointer(op.path);
      op.path =
          at->is_object() ? (pointer / name).to_string() : (pointer / below(at->size() + 1)).to_string();
      op.after = value(2);
      return op;
    }
    if (at->empty() || (!op.path.empty() && below(5) == 0)) break;
    const std::size_t index = below(at->size());
    const auto part = std::next(at->begin(), static_cast<std::ptrdiff_t>(index));
    const Json::json_pointer pointer(op.path);
    op.path = at->is_object() ? (pointer / part.key()).to_string() : (pointer / index).to_string();
    at = &*part;
  }
  op.before = *at;
  if (!op.path.empty() && below(3) == 0) return op;
  op.after = value(2);
  // A part of an object or a list that stays.
  if (at->is_structured() && at->size() > 1 && below(2) == 0) {
    op.after = *at;
    op.after->erase(op.after->begin());
    if (at->is_array() && below(2) == 0) op.after->insert(op.after->begin(), value(1));
    if (at->is_object() && below(2) == 0) (*op.after)[key()] = value(1);
  }
  return op;
}

}  // namespace shelfbeam::serve
