#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/temp_folder.hpp"
#include "unit/scene/sample_store.hpp"
#include "unit/scene/solids.hpp"

namespace shelfbeam::test {

using Corner = std::array<float, 3>;
using Triangles = std::vector<std::array<Corner, 3>>;

/// A corner block of 1 x 2 x 3: a closed tetrahedron that faces outwards.
inline Triangles tetrahedron() {
  const Corner o{0, 0, 0}, x{1, 0, 0}, y{0, 2, 0}, z{0, 0, 3};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}
inline constexpr double tetrahedron_area = 0.5 * (2 + 3 + 6 + 7);  // the slanted side: |(6, 3, 2)| / 2

inline std::string bytes_of(const auto& value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

inline std::string ascii_stl(const Triangles& triangles) {
  std::string text = "solid made for a test\n";
  for (const auto& triangle : triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const auto& [x, y, z] : triangle) text += fmt::format("      vertex {} {} {}\n", x, y, z);
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid\n";
}

inline std::string binary_stl(const Triangles& triangles) {
  std::string bytes = "solid is how a binary file may begin, too";
  bytes.resize(80, ' ');
  bytes += bytes_of(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles)
    bytes.append(bytes_of(Corner{})).append(bytes_of(triangle)).append(bytes_of(std::uint16_t{0}));
  return bytes;
}

/// Each triangle has its own vertices; a colour precedes the coordinates.
inline std::string ply(const Triangles& triangles, bool binary) {
  std::string text = fmt::format(
      "ply\nformat {} 1.0\ncomment made for a test\nelement vertex {}\nproperty uchar red\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\nproperty list uchar int "
      "vertex_indices\nend_header\n",
      binary ? "binary_little_endian" : "ascii", 3 * triangles.size(), triangles.size());
  for (const auto& triangle : triangles)
    for (const Corner& corner : triangle)
      text += binary ? bytes_of(std::uint8_t{200}) + bytes_of(corner)
                     : fmt::format("200 {} {} {}\n", corner[0], corner[1], corner[2]);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(3 * triangles.size()); k += 3)
    text += binary ? bytes_of(std::uint8_t{3}) + bytes_of(std::array{k, k + 1, k + 2})
                   : fmt::format("3 {} {} {}\n", k, k + 1, k + 2);
  return text;
}

inline std::string obj(const Triangles& triangles) {
  std::string text;
  for (const auto& triangle : triangles) {
    for (const auto& [x, y, z] : triangle) text += fmt::format("v {} {} {}\n", x, y, z);
    text += "f -3 -2 -1\n";
  }
  return text;
}

/// The sample without a room and with a mesh file as its only fixture.
inline Json mesh_store(const std::string& file, const Json& materials = {{"*", "white"}}) {
  Json store = sample_store();
  store.erase("room");
  store["transceivers"] = {{"list", {{{"id", "T"}, {"position", {0.1, 0.1, 0.1}}, {"type", "down"}}}}};
  store["fixtures"] = {
      {{"type", "mesh"}, {"id", "M"}, {"file", file}, {"at", {0, 0, 0}}, {"materials", materials}}};
  return store;
}

/// The scene of mesh_store with this mesh file.
inline Scene read_mesh(const std::string& name, const std::string& content,
                       const Json& materials = {{"*", "white"}}) {
  const TempFolder folder;
  folder.write(name, content);
  return scene_of(mesh_store(name, materials), folder.path());
}

/// The warnings about the mesh file itself.
inline std::vector<std::string> file_warnings(const Scene& scene) {
  std::vector<std::string> warnings = sentences(scene.warnings);
  std::erase_if(warnings, [](const std::string& w) { return w.find("the mesh '") == std::string::npos; });
  return warnings;
}

}  // namespace shelfbeam::test
