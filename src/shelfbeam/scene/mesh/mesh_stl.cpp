#include <cstdint>
#include <cstring>
#include <string>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

void read_ascii(MeshLines& lines, MeshTriangles& triangles) {
  bool is_open = true;
  std::vector<Vec3> corners;
  while (lines.next()) {
    const std::string word = lower_case(lines.words()[0]);
    if (word == "vertex") corners.push_back({lines.coordinate(1), lines.coordinate(2), lines.coordinate(3)});
    if (word == "endloop" || word == "endfacet") {
      lines.require_added(triangles.add_face(corners), corners.size());
      corners.clear();
    }
    if (word == "solid") is_open = true;
    if (word == "endsolid") is_open = false;
  }
  if (is_open) lines.fail_file("ends before 'endsolid', so it is truncated or not an STL file");
}

constexpr std::size_t header = 84, facet = 50;

// A binary STL file may also begin with the "solid" of ASCII files, so only its length is decisive.
bool is_binary(std::string_view text) {
  if (text.size() < header) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, text.data() + 80, sizeof count);
  return text.size() == header + facet * std::size_t{count};
}

// A facet consists of its normal, which is ignored, three corners and two bytes.
void read_binary(MeshLines& lines, MeshTriangles& triangles) {
  const std::string_view bytes = lines.rest();
  std::size_t vertex = 0;
  for (std::size_t at = header; at < bytes.size(); at += facet) {
    float numbers[9];
    std::memcpy(numbers, bytes.data() + at + 12, sizeof numbers);
    MeshTriangles::Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = lines.finite({numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]}, vertex++);
    lines.require_added(triangles.add(triangle), 3);
  }
}

}  // namespace

void read_stl(MeshLines& lines, MeshTriangles& triangles) {
  if (is_binary(lines.rest()))
    read_binary(lines, triangles);
  else
    read_ascii(lines, triangles);
}

}  // namespace shelfbeam
