// Random edits of random texts, against a model that knows values only.

#include "serve/text/edit.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

// Random JSON values, texts of them with comments in many layouts, and edits.
class RandomJson {
 public:
  explicit RandomJson(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }

  Json value(std::size_t levels) {
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

  // A text that reads as the value.
  std::string text(const Json& value) {
    layout_ = below(layouts);
    line_end_ = any({"\n", "\n", "\r\n", "\r"});
    std::string text = below(4) == 0 ? "\xEF\xBB\xBF" : "";
    if (layout_ >= lines) text += "// first " + line_end_;
    write(value, 0, text);
    if (layout_ >= lines) text += gap() + "// last";
    return text;
  }

  // An operation that fits the value.
  EditOp op(const Json& root) {
    EditOp op;
    const Json* at = &root;
    // Half of the steps end at a part that is a leaf, or at a new place.
    while (at->is_structured()) {
      const Json::json_pointer pointer(op.path);
      if (below(4) == 0) {
        const std::string name = at->is_object() ? key() : "";
        if (at->is_object() && at->contains(name)) continue;
        op.path =
            at->is_object() ? (pointer / name).to_string() : (pointer / below(at->size() + 1)).to_string();
        op.after = value(2);
        return op;
      }
      if (at->empty() || (!op.path.empty() && below(5) == 0)) break;
      const std::size_t index = below(at->size());
      const auto part = std::next(at->begin(), static_cast<std::ptrdiff_t>(index));
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

 private:
  enum : std::size_t { minified, one_line, lines, disorder, layouts };

  std::string any(std::initializer_list<const char*> texts) { return *(texts.begin() + below(texts.size())); }
  std::string key() { return any({"a", "b", "type", "at", "~", "/", "", "0", "x y", "\"q\"", "ü", "//"}); }
  std::string blanks() { return any({"", "", " ", "\t", "  "}); }

  std::string gap() {
    std::string gap = blanks();
    if (below(3) > 0) return gap;
    for (std::size_t parts = below(4); parts > 0; --parts) {
      const std::string comment = any({"/* ] \" */", "/**/", "// }, \"", "//"});
      gap += comment + (comment.starts_with("//") ? line_end_ : "") + blanks();
      if (below(3) == 0) gap += line_end_ + blanks();
    }
    return gap;
  }

  std::string line_gap() {
    std::string gap = any({"", "", " // on the line", " /* on the line */"});
    if (below(6) == 0) gap += line_end_;
    if (below(4) == 0) gap += line_end_ + "  // above";
    return gap + line_end_;
  }

  void write(const Json& value, std::size_t level, std::string& text) {
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

  std::mt19937_64 random_;
  std::size_t layout_ = 0;
  std::string line_end_;
};

// The tokens of a JSON text with comments, found without the code under test.
class TokenWalk {
 public:
  struct Range {
    std::size_t begin, end;  // bytes
  };

  explicit TokenWalk(std::string_view text) {
    read_tokens(text);
    read_value("", 0);
  }

  // The bytes that an operation may change: a value, or all between the tokens, other than commas, around the
  // place of an insertion or a removal.
  Range changed_by(const EditOp& op) const {
    const auto found = parts_.find(op.path);
    if (op.before && op.after) return {tokens_[found->second.value].begin, tokens_[found->second.last].end};
    if (op.before) return around(found->second.first, found->second.last + 1);
    if (found != parts_.end()) return around(found->second.first, found->second.first);
    const Part& parent = parts_.at(Json::json_pointer(op.path).parent_pointer().to_string());
    return around(parent.last, parent.last);
  }
  const std::vector<std::string>& comments() const { return comments_; }

 private:
  struct Part {
    std::size_t first, value, last;  // tokens
  };

  void read_tokens(std::string_view text) {
    for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
      const std::size_t begin = at;
      const char c = text[at];
      if (c == '/') {
        at = text[at + 1] == '/' ? text.find_first_of("\r\n", at) : text.find("*/", at + 2) + 2;
        at = std::min(at, text.size());
        comments_.emplace_back(text.substr(begin, at - begin));
        continue;
      }
      if (std::string_view(" \t\r\n").find(c) != std::string_view::npos) {
        ++at;
        continue;
      }
      if (c == '"') {
        do at += text[at] == '\\' ? 2 : 1;
        while (text[at] != '"');
        ++at;
      } else if (std::string_view("{}[],:").find(c) != std::string_view::npos) {
        ++at;
      } else {
        while (at < text.size() &&
               std::string_view("{}[],: \t\r\n/").find(text[at]) == std::string_view::npos)
          ++at;
      }
      tokens_.push_back({begin, at});
      kinds_.push_back(c);
      texts_.emplace_back(text.substr(begin, at - begin));
    }
  }

  void read_value(const std::string& path, std::size_t first) {
    Part part{first, at_, at_};
    const char kind = kinds_[at_++];
    if (kind == '{' || kind == '[') {
      std::size_t index = 0;
      while (kinds_[at_] != '}' && kinds_[at_] != ']') {
        if (kinds_[at_] == ',') {
          ++at_;
          continue;
        }
        const std::size_t begin = at_;
        const Json::json_pointer pointer(path);
        if (kind == '[') {
          read_value((pointer / index++).to_string(), begin);
        } else {
          at_ += 2;
          read_value((pointer / Json::parse(texts_[begin]).get<std::string>()).to_string(), begin);
        }
      }
      part.last = at_++;
    }
    parts_[path] = part;
  }

  Range around(std::size_t first, std::size_t last) const {
    do --first;
    while (kinds_[first] == ',');
    while (kinds_[last] == ',') ++last;
    return {tokens_[first].end, tokens_[last].begin};
  }

  std::vector<Range> tokens_;
  std::vector<char> kinds_;  // first characters
  std::vector<std::string> texts_, comments_;
  std::size_t at_ = 0;
  std::map<std::string, Part> parts_;
};

using Ops = std::vector<EditOp>;
using Edit = std::function<EditedText(const std::string&, const Ops&)>;

void apply_to_model(Json& model, const EditOp& op) {
  Json patch{{"path", op.path}, {"op", op.before ? op.after ? "replace" : "remove" : "add"}};
  if (op.after) patch["value"] = *op.after;
  model = model.patch(Json::array({patch}));
}

// What is wrong with an edit; empty if nothing is.
std::string mistake(const std::string& text, const Ops& ops, const EditedText& result, const Json& model) {
  if (!same_value(parse_json(result.text, "result"), model)) return "another value";
  if (!same_value(result.value, model)) return "another returned value";
  if (spliced(text, result.splices) != result.text) return "other replacements";
  if (spliced(result.text, inverse(result.splices)) != text) return "replacements without inverse";
  if (ops.size() != 1) return {};
  const TokenWalk tokens(text);
  const TokenWalk::Range may_change = tokens.changed_by(ops[0]);
  if (!result.text.starts_with(text.substr(0, may_change.begin))) return "other bytes before the place";
  if (!result.text.ends_with(text.substr(may_change.end))) return "other bytes behind the place";
  if (!ops[0].before && TokenWalk(result.text).comments() != tokens.comments()) return "another comment";
  if (ops[0].before && ops[0].after && same_value(*ops[0].before, *ops[0].after) && !result.splices.empty())
    return "bytes of an equal value";
  return {};
}

// Edits, undoes and redoes at random, then undoes everything. Returns the first mistake.
std::string first_mistake(const Edit& edit, std::size_t edits, std::uint64_t seed) {
  RandomJson random(seed);
  constexpr std::size_t edits_per_text = 50;
  for (std::size_t done = 0; done < edits;) {
    Json model;
    while (!model.is_structured()) model = random.value(4);
    const std::string first = random.text(model);
    std::string text = first;
    std::vector<EditedText> steps;
    std::vector<std::string> before;
    for (std::size_t k = 0; k < edits_per_text; ++k, ++done) {
      Ops ops;
      for (std::size_t count = random.below(3) == 0 ? 1 + random.below(4) : 1; count > 0; --count) {
        ops.push_back(random.op(model));
        apply_to_model(model, ops.back());
      }
      EditedText result = edit(text, ops);
      if (const std::string found = mistake(text, ops, result, model); !found.empty())
        return fmt::format("{} after\n{}\nin\n{}\nwhich became\n{}", found, ops[0].path, text, result.text);
      before.push_back(text);
      text = result.text;
      steps.push_back(std::move(result));
      if (random.below(8) > 0) continue;
      const std::size_t undone = random.below(steps.size() + 1);
      for (std::size_t step = steps.size(); step > steps.size() - undone; --step) {
        text = spliced(text, inverse(steps[step - 1].splices));
        if (text != before[step - 1]) return "an undone step does not lead back";
      }
      for (std::size_t step = steps.size() - undone; step < steps.size(); ++step)
        text = spliced(text, steps[step].splices);
      if (!steps.empty() && text != steps.back().text) return "redone steps lead elsewhere";
    }
    for (auto step = steps.rbegin(); step != steps.rend(); ++step)
      text = spliced(text, inverse(step->splices));
    if (text != first) return "the first text is not found again";
  }
  return {};
}

TEST(RandomEdits, AgreeWithAModel) {
  EXPECT_EQ(first_mistake(edited, 3000, 1), "");
}

TEST(LongRandomEdits, AgreeWithAModel) {
  EXPECT_EQ(first_mistake(edited, 100'000, 2), "");
}

// Negative control: a wrong edit among fifty is noticed.
TEST(RandomEdits, MistakesAreNoticed) {
  const auto noticed = [](const std::function<void(std::string&)>& spoil) {
    const Edit wrong = [&, count = 0](const std::string& text, const Ops& ops) mutable {
      EditedText result = edited(text, ops);
      if (++count % 50 != 0) return result;
      spoil(result.text);
      return result.splices = {splice_between(text, result.text)}, result;
    };
    return first_mistake(wrong, 2000, 3);
  };
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find("// last"); at != std::string::npos) text.erase(at, 7);
            }).find("behind the place"),
            std::string::npos)
      << "a lost comment";
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find("0,"); at != std::string::npos) text[at] = '1';
            }).find("another value"),
            std::string::npos);
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find('\t'); at != std::string::npos) text[at] = ' ';
            }).find("bytes"),
            std::string::npos);
}

}  // namespace
}  // namespace shelfbeam::serve
