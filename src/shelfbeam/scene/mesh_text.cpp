#include "shelfbeam/scene/mesh_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/mesh_lines.hpp"
#include "shelfbeam/scene/mesh_ply.hpp"

namespace shelfbeam {

namespace {

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

// `v x y z`, and after them a weight or a colour; `f` and its corners. A line that goes on in the next one is
// left to Assimp.
void check_obj(MeshLines& lines) {
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.back() == "\\") continue;
    if (words[0] == "v")
      for (std::size_t axis = 1; axis <= 3; ++axis) lines.expect_coordinate(axis);
    if (words[0] == "f" && words.size() < 4) lines.fail("a face has fewer than three corners");
  }
}

void check_stl(MeshLines& lines) {
  bool is_open = true;
  while (lines.next()) {
    const std::string word = lower_case(lines.words()[0]);
    if (word == "vertex")
      for (std::size_t axis = 1; axis <= 3; ++axis) lines.expect_coordinate(axis);
    if (word == "solid") is_open = true;
    if (word == "endsolid") is_open = false;
  }
  if (is_open) lines.fail_file("ends before its 'endsolid': it is truncated, or no STL file");
}

// A binary STL may begin with the "solid" of the ASCII one; its length tells.
bool is_binary_stl(std::string_view text) {
  if (text.size() < 84) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, text.data() + 80, sizeof triangles);
  return text.size() == 84 + 50 * std::size_t{triangles};
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
