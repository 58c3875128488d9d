#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/device/device_types.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

using Vec2 = std::array<double, 2>;  ///< in plan, m

struct Label {
  std::string id;
  Vec3 position;  ///< m
  Vec3 normal;    ///< unit
  LabelTypeId type;
};

struct Transceiver {
  std::string id;
  Vec3 position;        ///< m
  Vec3 axis{0, 0, -1};  ///< unit; straight down unless told otherwise
  double roll_deg = 0;
  TransceiverTypeId type;
  bool installed = false;
};

struct NamedMaterial {
  std::string name;
  Material material;
  /// Within which the given reflectance (given_reflectance) is known, both ends included; none: not told.
  std::optional<std::array<double, 2>> reflectance_range = {};
};

/// Surfaces that shine: all triangles of a material emit this radiance from both sides. A light source like a
/// transceiver, for tests that need one of known light; no store file has them.
struct EmittingSurface {
  std::string id;
  MaterialId material;
  double radiance = 0;  ///< W/(m^2 sr)
};

/// The triangles of a scene: indexed, two-sided, one material each.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MaterialId> materials;  ///< one a triangle
};

enum class PartKind { shell, panel, board, kick_plate, goods, tub, casing, door, solid, mesh };

/// A piece of a fixture as drawings need it: an upright prism (for a mesh: around the convex hull of its
/// plan; of a door, which is a pane without thickness, in plan or in height nothing).
struct Part {
  PartKind kind = PartKind::solid;
  std::uint32_t fixture = 0;  ///< index into Scene::fixtures
  MaterialId material;
  std::vector<Vec2> footprint;                           ///< counter-clockwise polygon in plan, m
  double bottom = 0, top = 0;                            ///< m
  std::uint32_t first_triangle = 0, triangle_count = 0;  ///< in Scene::mesh, of a mesh; of others no matter
};

struct FixtureOutline {
  std::string id;
  std::string type;             ///< as in the store file: "gondola"
  std::vector<Vec2> footprint;  ///< counter-clockwise polygon in plan, m
  double height = 0;            ///< m
  double rotation_deg = 0;
};

/// Everything a simulation needs, checked and frozen: made by `make_scene`, passed on as const.
struct Scene {
  /// content_hash of the resolved store that it was made of. Empty where it was made by hand; clear it when
  /// you change a scene.
  std::string store_hash;
  std::string name;
  double wavelength_nm = 940;
  std::optional<Vec3> room;  ///< size of the axis-aligned shell from the origin
  Vec3 lower, upper;         ///< bounds of all triangles
  std::vector<NamedMaterial> materials;
  std::vector<LabelType> label_types;
  std::vector<TransceiverType> transceiver_types;
  TriangleMesh mesh;
  std::vector<FixtureOutline> fixtures;
  std::vector<Part> parts;
  std::vector<Label> labels;
  std::vector<Transceiver> transceivers;
  std::vector<EmittingSurface> emitting_surfaces;
  std::vector<std::string> warnings;

  const LabelType& type_of(const Label& label) const { return label_types[label.type.value]; }
  const TransceiverType& type_of(const Transceiver& t) const { return transceiver_types[t.type.value]; }

  /// By material: whether a surface is made of it.
  std::vector<bool> used_materials() const {
    std::vector<bool> used(materials.size(), false);
    for (const MaterialId material : mesh.materials) used[material.value] = true;
    return used;
  }
};

/// Identifies a scene in checkpoints and in what is computed from it: its store_hash, or where it has none a
/// hash of all that a simulation depends on.
std::string scene_hash(const Scene& scene);

}  // namespace shelfbeam
