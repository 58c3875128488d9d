#include "shelfbeam/scene/glb/glb_file.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

namespace {

// Numbers that the specification assigns.
constexpr int float_type = 5126, uint32_type = 5125, vertex_target = 34962, index_target = 34963;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

constexpr std::size_t position_view = 0, index_view = 1;

template <class T>
std::size_t bytes_in(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), bytes_in(values));
}

void append(std::string& bytes, std::initializer_list<std::uint32_t> values) {
  append(bytes, std::vector<std::uint32_t>(values));
}

}  // namespace

GlbFile::GlbFile(const std::string& name) {
  const double half = std::sqrt(0.5);  // the quaternion of a quarter turn about x
  nodes_.push_back({{"name", name}, {"rotation", {-half, 0.0, 0.0, half}}, {"children", Json::array()}});
}

std::size_t GlbFile::add_material(const GlbMaterial& material) {
  const auto& [red, green, blue] = material.colour;
  Json json = {{"name", material.name},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", {red, green, blue, material.opacity}},
                 {"metallicFactor", material.metallic},
                 {"roughnessFactor", material.roughness}}},
               {"doubleSided", true}};
  if (material.opacity < 1) json["alphaMode"] = "BLEND";
  materials_.push_back(std::move(json));
  return materials_.size() - 1;
}

void GlbFile::add_node(const std::string& name, const std::vector<GlbSurface>& surfaces) {
  Json primitives = Json::array();
  for (const GlbSurface& surface : surfaces)
    if (!surface.triangles.empty())
      primitives.push_back({{"attributes", {{"POSITION", add_positions(surface.vertices)}}},
                            {"indices", add_indices(surface.triangles)},
                            {"material", surface.material}});
  Json node = {{"name", name}};
  if (!primitives.empty()) {
    node["mesh"] = meshes_.size();
    meshes_.push_back({{"name", name}, {"primitives", std::move(primitives)}});
  }
  nodes_[0]["children"].push_back(nodes_.size());
  nodes_.push_back(std::move(node));
}

// The specification requires the bounds of positions, after rounding.
std::size_t GlbFile::add_positions(const std::vector<Vec3>& vertices) {
  const std::size_t offset = bytes_in(positions_);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Vec3& vertex : vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<float>(vertex[static_cast<int>(axis)]);
      positions_.push_back(value);
      low[axis] = std::min(low[axis], value);
      high[axis] = std::max(high[axis], value);
    }
  accessors_.push_back({{"bufferView", position_view},
                        {"byteOffset", offset},
                        {"componentType", float_type},
                        {"count", vertices.size()},
                        {"type", "VEC3"},
                        {"min", low},
                        {"max", high}});
  return accessors_.size() - 1;
}

std::size_t GlbFile::add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const std::size_t offset = bytes_in(indices_);
  for (const auto& triangle : triangles) indices_.insert(indices_.end(), triangle.begin(), triangle.end());
  accessors_.push_back({{"bufferView", index_view},
                        {"byteOffset", offset},
                        {"componentType", uint32_type},
                        {"count", 3 * triangles.size()},
                        {"type", "SCALAR"}});
  return accessors_.size() - 1;
}

std::string GlbFile::json_text() const {
  const std::size_t positions = bytes_in(positions_), indices = bytes_in(indices_);
  Json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "shelfbeam"}};
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"nodes", {0}}}});
  json["nodes"] = nodes_;
  json["meshes"] = meshes_;
  json["materials"] = materials_;
  json["accessors"] = accessors_;
  json["bufferViews"] = Json::array(
      {{{"buffer", 0},
        {"byteOffset", 0},
        {"byteLength", positions},
        {"byteStride", 3 * sizeof(float)},
        {"target", vertex_target}},
       {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", indices}, {"target", index_target}}});
  json["buffers"] = Json::array({{{"byteLength", positions + indices}}});
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');  // chunks begin at multiples of 4 bytes
  return text;
}

std::string GlbFile::bytes() const {
  constexpr std::size_t file_header = 12, chunk_header = 8;
  const std::string json = json_text();
  const std::size_t binary = bytes_in(positions_) + bytes_in(indices_);
  const std::size_t size = file_header + chunk_header + json.size() + chunk_header + binary;
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw InputError("", fmt::format("the 3-D model has {} bytes, but a GLB file at most 4 GiB", size),
                     "simplify the meshes of the store");
  std::string bytes = "glTF";
  bytes.reserve(size);
  append(bytes, {2, static_cast<std::uint32_t>(size)});
  append(bytes, {static_cast<std::uint32_t>(json.size()), json_chunk});
  bytes += json;
  append(bytes, {static_cast<std::uint32_t>(binary), binary_chunk});
  append(bytes, positions_);
  append(bytes, indices_);
  return bytes;
}

}  // namespace shelfbeam
