#include "shelfbeam/scene/mesh/mesh_formats.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

constexpr const char* repair_advice = "repair the mesh in the program that wrote it";

void split(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view blank = " \t\r\f\v";
  words.clear();
  for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blank, end);
  }
}

}  // namespace

void MeshLines::drop_mark() {
  text_ = without_mark(text_, fmt::format("{}: '{}'", where_, file_.string()));
}

bool MeshLines::next() {
  do {
    if (!next_line()) return false;
  } while (words_.empty());
  return true;
}

bool MeshLines::next_line() {
  if (at_ >= text_.size()) return false;
  std::string_view line = text_.substr(at_);
  line = line.substr(0, line.find('\n'));
  line = line.substr(0, line.find('\r'));
  split(line, words_);
  at_ += line.size();
  const std::string_view end = text_.substr(at_, 2);
  if (line_++ == 0) ends_with_cr_ = end.starts_with('\r') && end != "\r\n";
  // Behind a CR, a line feed may be the first byte of a binary PLY file.
  at_ += end == "\r\n" && !ends_with_cr_ ? 2 : 1;
  return true;
}

bool MeshLines::next_of_obj() {
  do {
    if (!next_line()) return false;
    drop_comment();
  } while (words_.empty());
  while (words_.back().ends_with('\\')) {
    words_.back().remove_suffix(1);
    std::vector<std::string_view> before = std::exchange(words_, {});
    if (before.back().empty()) before.pop_back();
    const bool continues = next_line();
    if (continues) {
      drop_comment();
      before.insert(before.end(), words_.begin(), words_.end());
    }
    words_ = std::move(before);
    if (words_.empty()) words_.emplace_back();
    if (!continues) break;
  }
  return true;
}

void MeshLines::drop_comment() {
  const bool has_name = !words_.empty() && words_[0] == "usemtl";
  for (std::size_t k = 0; k < words_.size(); ++k) {
    const std::size_t begin = words_[k].find('#');
    if (begin == std::string_view::npos || (has_name && begin > 0)) continue;
    const bool is_number =
        words_[k].size() > 1 && words_[k].find_first_not_of("0123456789", 1) == words_[k].npos;
    if (has_name && k > 1 && k + 1 == words_.size() && is_number) continue;
    words_[k] = words_[k].substr(0, begin);
    words_.resize(begin > 0 ? k + 1 : k);
    return;
  }
}

std::string_view MeshLines::from(std::size_t word) const {
  const char* begin = words_[word].data();
  return {begin, static_cast<std::size_t>(words_.back().data() + words_.back().size() - begin)};
}

double MeshLines::coordinate(std::size_t word) const {
  if (word >= words_.size()) fail("a coordinate is missing");
  const auto number = to_number(words_[word]);
  if (number && std::isfinite(*number)) return *number;
  fail(is_utf8(words_[word])
           ? fmt::format("the coordinate {} is not a finite number", in_quotes(words_[word]))
           : "a coordinate is not a number");
}

Vec3 MeshLines::finite(const Vec3& vertex, std::size_t number) const {
  if (is_finite(vertex)) return vertex;
  throw InputError(where_,
                   fmt::format("vertex {} (counted from 0) of '{}' is not finite", number, file_.string()),
                   repair_advice);
}

void MeshLines::require_added(bool taken, std::size_t corners) const {
  if (taken) return;
  if (corners > MeshTriangles::max_corners) fail(fmt::format("a concave face has {} corners", corners));
  throw InputError(where_, fmt::format("the mesh '{}' has more triangles than fit in memory", file_.string()),
                   "simplify it, or raise the memory limit");
}

void MeshLines::fail(const std::string& problem) const {
  throw InputError(where_, fmt::format("line {} of '{}': {}", line_, file_.string(), problem), repair_advice);
}

void MeshLines::fail_file(const std::string& problem) const {
  throw InputError(where_, fmt::format("the mesh '{}' {}", file_.string(), problem), repair_advice);
}

}  // namespace shelfbeam
