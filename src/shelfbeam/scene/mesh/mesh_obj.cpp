#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

// Statements that add free-form surfaces or the contents of another file.
bool adds_other_surfaces(std::string_view keyword) {
  constexpr std::array<std::string_view, 7> keywords{"surf", "call", "bzp", "bsp", "cdp", "res", "csh"};
  return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

class ObjReader {
 public:
  ObjReader(MeshLines& lines, MeshTriangles& triangles) : lines_(lines), triangles_(triangles) {}

  void read() {
    while (lines_.next_of_obj()) {
      const std::string_view keyword = lines_.words()[0];
      if (keyword == "v") {
        // A weight or a colour may follow.
        vertices_.push_back({lines_.coordinate(1), lines_.coordinate(2), lines_.coordinate(3)});
      } else if (keyword == "f" || keyword == "fo") {
        read_face();
      } else if (keyword == "usemtl") {
        triangles_.use(lines_.words().size() > 1 ? lines_.from(1) : "");
      } else if (adds_other_surfaces(keyword)) {
        lines_.fail(
            fmt::format("{} adds surfaces that are not supported; only faces are read", in_quotes(keyword)));
      } else if (std::any_of(keyword.begin(), keyword.end(), [](char c) { return c < '!' || c > '~'; })) {
        // Such as a byte order mark where files were joined: the line may be a vertex.
        lines_.fail(fmt::format("the keyword {} has characters that are not printable", in_quotes(keyword)));
      }
    }
  }

 private:
  void read_face() {
    const auto& words = lines_.words();
    if (words.size() < 4) lines_.fail("a face has fewer than three corners");
    corners_.clear();
    for (std::size_t k = 1; k < words.size(); ++k) corners_.push_back(corner(words[k]));
    lines_.require_added(triangles_.add_face(corners_), corners_.size());
  }

  // `7`, `7/1`, `7/1/2` or `7//2`, the vertex from 1; -1 is the last.
  Vec3 corner(std::string_view word) const {
    const std::string_view digits = word.substr(0, word.find('/'));
    std::int64_t index = 0;
    const auto [stopped, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc{} || stopped != digits.data() + digits.size())
      lines_.fail("a corner of a face is not a vertex number");
    const auto count = static_cast<std::int64_t>(vertices_.size());
    if (index == 0 || index > count || index < -count)
      lines_.fail(fmt::format("a face names vertex {} of {}, counted from 1", index, count));
    return vertices_[static_cast<std::size_t>(index > 0 ? index - 1 : count + index)];
  }

  MeshLines& lines_;
  MeshTriangles& triangles_;
  std::vector<Vec3> vertices_, corners_;
};

}  // namespace

void read_obj(MeshLines& lines, MeshTriangles& triangles) {
  lines.drop_mark();
  ObjReader(lines, triangles).read();
}

}  // namespace shelfbeam
