#include "shelfbeam/scene/mesh_lines.hpp"

#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

constexpr const char* advice = "repair the mesh in the program that wrote it";

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

bool MeshLines::next() {
  do {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    split(text_.substr(at_, end - at_), words_);
    at_ = end + 1;
    ++line_;
  } while (words_.empty());
  return true;
}

void MeshLines::expect_coordinate(std::size_t word) const {
  if (word >= words_.size()) fail("a coordinate is missing");
  const auto number = to_number(words_[word]);
  if (number && std::isfinite(*number)) return;
  fail(is_utf8(words_[word])
           ? fmt::format("the coordinate '{}' is no finite number", words_[word].substr(0, 40))
           : "a coordinate is no number");
}

void MeshLines::fail(const std::string& problem) const {
  throw InputError(where_, fmt::format("line {} of '{}': {}", line_, file_.string(), problem), advice);
}

void MeshLines::fail_file(const std::string& problem) const {
  throw InputError(where_, fmt::format("the mesh '{}' {}", file_.string(), problem), advice);
}

}  // namespace shelfbeam
