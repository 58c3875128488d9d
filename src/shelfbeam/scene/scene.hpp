#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/locale/language.hpp"
#include "shelfbeam/device/device_types.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/label/label_place.hpp"
#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

struct Label {
  std::string id;
  Vec3 position;  ///< m
  Vec3 normal;    ///< unit length
  LabelTypeId type;
  double relative_sensitivity = 1;  ///< to that of its type
  std::string description = {};     ///< of its article ("Rye bread"); may be empty
  LabelPlace place = {};
  bool is_receiver = false;  ///< measures light in the air, and is mounted on nothing
};

struct Transceiver {
  std::string id;
  Vec3 position;        ///< m
  Vec3 axis{0, 0, -1};  ///< unit length; straight down by default
  double roll_deg = 0;
  TransceiverTypeId type;
  bool installed = false;
  bool pinned = false;        ///< not installed, but part of every selection
  bool selected = false;      ///< part of the choice in the store file, which binds no plan
  double relative_power = 1;  ///< to that of its type

  /// Whether the unit counts where the units of the store are examined.
  bool is_chosen() const { return installed || pinned || selected; }
};

struct NamedMaterial {
  std::string name;
  Material material;
  /// The range of the given reflectance (given_reflectance), both ends included; nothing if unknown.
  std::optional<std::array<double, 2>> reflectance_range = {};
};

/// A luminous surface: all triangles of a material emit this radiance from both sides. It is a light source
/// like a transceiver, for tests that require known light. Store files cannot contain it.
struct EmittingSurface {
  std::string id;
  MaterialId material;
  double radiance = 0;  ///< W/(m^2 sr)
};

/// The triangles of a scene: indexed, two-sided, one material each.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MaterialId> materials;  ///< one per triangle

  double area_of(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return length(cross(vertices[b] - vertices[a], vertices[c] - vertices[a])) / 2;
  }
};

enum class PartKind { shell, panel, board, kick_plate, goods, tub, casing, door, solid, mesh };

/// A part of a fixture for drawings: an upright prism, for a mesh over the convex hull of its plan. A door is
/// a pane, so its prism has no thickness in plan or no height.
struct Part {
  PartKind kind = PartKind::solid;
  std::uint32_t fixture = 0;  ///< index into Scene::fixtures
  MaterialId material;
  std::vector<Vec2> footprint;                           ///< counter-clockwise polygon in plan, m
  double bottom = 0, top = 0;                            ///< m
  std::uint32_t first_triangle = 0, triangle_count = 0;  ///< in Scene::mesh; only for meshes
};

/// The form of a fixture, on which drawings and checks depend. Its type gives it.
enum class FixtureForm : std::uint8_t {
  block,  ///< upright, with a convex outline
  prism,  ///< upright, with any outline
  rack,   ///< with boards
  chest,  ///< open above
  sheet,  ///< a parallelogram without thickness
  mesh,
  wall,  ///< an inner wall of the room
};

struct FixtureOutline {
  std::string id;
  std::string type;             ///< as in the store file ("gondola"), or "wall" for an inner wall
  std::vector<Vec2> footprint;  ///< counter-clockwise polygon in plan, m
  double height = 0;            ///< m
  double rotation_deg = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;  ///< in Scene::mesh; of all parts
  FixtureForm form = FixtureForm::block;

  bool is_wall() const { return form == FixtureForm::wall; }
};

/// The complete, checked input of a simulation. `make_scene` constructs it; from then on it is const.
struct Scene {
  /// hash_of_resolved of the resolved store. Empty for a scene from other sources; clear it when you change a
  /// scene.
  std::string store_hash;
  std::string name;
  Language language = Language::english;  ///< of reports
  double wavelength_nm = 940;
  std::string currency;  ///< of the costs of transceivers; empty: not given
  std::optional<ValueSource> source = {};
  std::vector<DecisiveValue> values = {};  ///< the most influential first
  std::optional<RoomShape> room;
  Vec3 lower, upper;  ///< bounds of all triangles
  std::vector<NamedMaterial> materials;
  std::vector<double> areas;  ///< m^2, of the surfaces of each material, with goods of their mean height
  std::vector<LabelType> label_types;
  std::vector<TransceiverType> transceiver_types;
  TriangleMesh mesh;
  std::vector<FixtureOutline> fixtures;  ///< and inner walls, which come last
  std::vector<Part> parts;
  std::vector<Label> labels;
  std::vector<Transceiver> transceivers;
  std::vector<Transceiver> excluded;  ///< candidates that the store excludes by their ids
  std::vector<EmittingSurface> emitting_surfaces;
  std::vector<Finding> warnings;
  std::size_t ignored_warnings = 0;  ///< by the key "ignore" of elements of the store

  const LabelType& type_of(const Label& label) const { return label_types[label.type.value]; }
  const TransceiverType& type_of(const Transceiver& t) const { return transceiver_types[t.type.value]; }

  /// gamma tau (3.6) of a label, in the signal's unit of measure.
  double requirement_of(const Label& label) const {
    return type_of(label).requirement() / label.relative_sensitivity;
  }

  /// The irradiance, W/m^2, that gives a label its requirement from the direction of its largest response.
  /// Light on surfaces is measured by it, so that it does not matter in which unit a label measures.
  double irradiance_for(const Label& label) const {
    return requirement_of(label) / largest(type_of(label).responsivity);
  }

  /// The number of inner walls among `fixtures`.
  std::size_t inner_walls() const {
    return static_cast<std::size_t>(std::count_if(fixtures.begin(), fixtures.end(),
                                                  [](const auto& fixture) { return fixture.is_wall(); }));
  }

  /// For each material, whether a surface uses it.
  std::vector<bool> used_materials() const {
    std::vector<bool> used(materials.size(), false);
    for (const MaterialId material : mesh.materials) used[material.value] = true;
    return used;
  }
};

/// Identifies a scene in checkpoints and results: its store_hash or, if that is empty, a hash of everything
/// that affects a simulation, a placement or an analysis. So ranges of reflectances count, too, although a
/// simulation does not depend on them.
std::string scene_hash(const Scene& scene);

}  // namespace shelfbeam
