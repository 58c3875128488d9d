#include "shelfbeam/scene/mesh_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

class MeshLines {
 public:
  MeshLines(std::string_view text, const std::filesystem::path& file, const std::string& where)
      : text_(text), file_(file), where_(where) {}

  /// The next line that is not blank, as words.
  bool next() {
    do {
      if (at_ >= text_.size()) return false;
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      read_words(text_.substr(at_, end - at_));
      at_ = end + 1;
      ++line_;
    } while (words_.empty());
    return true;
  }
  const std::vector<std::string_view>& words() const { return words_; }

  void expect_coordinate(std::size_t word) const {
    if (word >= words_.size())
      fail("a coordinate is missing");
    else if (const auto number = to_number(words_[word]); !number || !std::isfinite(*number))
      fail(is_utf8(words_[word])
               ? fmt::format("the coordinate '{}' is no finite number", words_[word].substr(0, 40))
               : "a coordinate is no number");
  }

 private:
  void read_words(std::string_view line) {
    constexpr std::string_view blank = " \t\r\f\v";
    words_.clear();
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(blank, end);
    }
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(where_, fmt::format("line {} of '{}': {}", line_, file_.string(), problem),
                     "repair the mesh in the program that wrote it");
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  const std::string& where_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
};

// `v x y z`, and after them a weight or a colour. A line that goes on in the next one is left to Assimp.
void check_obj(MeshLines& lines) {
  while (lines.next())
    if (lines.words()[0] == "v" && lines.words().back() != "\\")
      for (std::size_t axis = 1; axis <= 3; ++axis) lines.expect_coordinate(axis);
}

void check_stl(MeshLines& lines) {
  while (lines.next())
    if (lower_case(lines.words()[0]) == "vertex")
      for (std::size_t axis = 1; axis <= 3; ++axis) lines.expect_coordinate(axis);
}

// A binary STL may begin with the "solid" of the ASCII one; its length tells.
bool is_binary_stl(std::string_view text) {
  if (text.size() < 84) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, text.data() + 80, sizeof triangles);
  return text.size() == 84 + 50 * std::size_t{triangles};
}

// The header lists elements, each with a count of lines and with columns.
void check_ply(MeshLines& lines) {
  struct Element {
    double count;
    bool is_vertex;
    std::vector<std::size_t> coordinates;  // columns of x, y and z
    std::size_t columns = 0;
  };
  std::vector<Element> elements;
  while (lines.next() && lines.words()[0] != "end_header") {
    const auto& words = lines.words();
    if (words[0] == "format" && (words.size() < 2 || words[1] != "ascii")) return;
    if (words[0] == "element" && words.size() == 3)
      elements.push_back({to_number(words[2]).value_or(0), words[1] == "vertex", {}, 0});
    if (words[0] == "property" && !elements.empty()) {
      Element& element = elements.back();
      if (words.back() == "x" || words.back() == "y" || words.back() == "z")
        element.coordinates.push_back(element.columns);
      ++element.columns;
      if (element.is_vertex && words.size() > 1 && words[1] == "list") return;  // columns are not fixed
    }
  }
  for (const Element& element : elements)
    for (double k = 0; k < element.count && lines.next(); ++k)
      if (element.is_vertex)
        for (const std::size_t column : element.coordinates) lines.expect_coordinate(column);
}

}  // namespace

std::string mesh_extension(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

void check_mesh_text(const std::filesystem::path& file, const std::string& where) {
  const std::string extension = mesh_extension(file);
  if (extension != ".obj" && extension != ".stl" && extension != ".ply") return;
  const std::string text = read_file(file);
  MeshLines lines(text, file, where);
  if (extension == ".obj") check_obj(lines);
  if (extension == ".stl" && !is_binary_stl(text)) check_stl(lines);
  if (extension == ".ply") check_ply(lines);
}

}  // namespace shelfbeam
