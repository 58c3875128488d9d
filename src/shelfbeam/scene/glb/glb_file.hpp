#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A material as viewers draw it. All values are from 0 to 1.
struct GlbMaterial {
  std::string name;
  std::array<double, 3> colour{};  ///< red, green, blue; linear, so that grey is a reflectance
  double metallic = 0, roughness = 1, opacity = 1;
};

/// Triangles of one material.
struct GlbSurface {
  std::size_t material = 0;  ///< from GlbFile::add_material
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of `vertices`
};

/// A binary glTF 2.0 file (GLB) that grows by materials and nodes. Positions are 32-bit numbers and there are
/// no normals, so viewers shade every triangle flat. All surfaces are two-sided.
class GlbFile {
 public:
  /// `name`: of the root node, whose children are all other nodes. It rotates them, because y is up in glTF.
  explicit GlbFile(const std::string& name);

  /// Returns the material's number.
  std::size_t add_material(const GlbMaterial& material);
  /// Adds a node without a transformation; surfaces without triangles are omitted.
  void add_node(const std::string& name, const std::vector<GlbSurface>& surfaces);

  /// The whole file, which depends only on the added materials and nodes: at least one material and one
  /// triangle. Throws InputError if it exceeds 4 GiB, the maximum of the format.
  std::string bytes() const;

 private:
  using Json = nlohmann::ordered_json;

  std::size_t add_positions(const std::vector<Vec3>& vertices);
  std::size_t add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles);
  std::string json_text() const;

  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
       accessors_ = Json::array();
  std::vector<float> positions_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace shelfbeam
