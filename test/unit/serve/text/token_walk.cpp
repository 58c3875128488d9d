#include "token_walk.hpp"

namespace shelfbeam::serve {

TokenWalk::TokenWalk(std::string_view text) {
  read_tokens(text);
  read_value("", 0);
}

void TokenWalk::read_tokens(std::string_view text) {
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
      while (at < text.size() && std::string_view("{}[],: \t\r\n/").find(text[at]) == std::string_view::npos)
        ++at;
    }
    tokens_.push_back({begin, at});
    kinds_.push_back(c);
    texts_.emplace_back(text.substr(begin, at - begin));
  }
}

void TokenWalk::read_value(const std::string& path, std::size_t first) {
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

Range TokenWalk::around(std::size_t first, std::size_t last) const {
  do --first;
  while (kinds_[first] == ',');
  while (kinds_[last] == ',') ++last;
  return {tokens_[first].end, tokens_[last].begin};
}

Range TokenWalk::changed_by(const EditOp& op) const {
  const auto found = parts_.find(op.path);
  if (op.before && op.after) return {tokens_[found->second.value].begin, tokens_[found->second.last].end};
  if (op.before) return around(found->second.first, found->second.last + 1);
  if (found != parts_.end()) return around(found->second.first, found->second.first);
  const Part& parent = parts_.at(Json::json_pointer(op.path).parent_pointer().to_string());
  return around(parent.last, parent.last);
}

}  // namespace shelfbeam::serve
