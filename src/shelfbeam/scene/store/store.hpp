#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/device/device_types.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

using Vec2 = std::array<double, 2>;

enum class Face { front, back, left, right };

/// The labels along the faces of a fixture.
struct FixtureLabels {
  LabelTypeId type;
  double spacing = 0.8;  ///< m
  std::vector<Face> faces;
  double tilt_deg = 0;  ///< how far the labels look up
};

/// What gondolas and freezers have in common.
struct Shelving {
  std::string id;
  Vec2 at{};  ///< corner of least x and y before rotation, m
  double rotation_deg = 0;
  double length = 0, depth = 0, height = 0;  ///< m
  MaterialId material;                       ///< of all but the goods
  MaterialId goods;
  std::optional<MaterialId> doors;  ///< panes that close it; not a solid dielectric
  double stocking = 0.8;            ///< share of the facings that hold goods; also how full these are
  std::optional<FixtureLabels> labels;
};

/// A run of shelving: back panel, kick plate with a bottom deck, boards, goods standing on them. With doors a
/// cabinet around these: walls at both ends, a top, a pane before each face.
struct Gondola : Shelving {
  std::vector<double> shelves;  ///< height of each board edge, ascending, m
  std::vector<Face> faces;      ///< sides that carry boards: front, back
};

/// A chest: a tub on a kick plate, goods inside, labels below its rim; with doors a pane as its lid.
struct Freezer : Shelving {};

struct Box {
  std::string id;
  Vec3 min, max;
  MaterialId material;
};

/// Triangles of one material out of a mesh file, in the file's units, z up.
struct MeshPiece {
  std::string name;  ///< of the material in the file
  MaterialId material;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct MeshFixture {
  std::string id;
  Vec3 at;
  double rotation_deg = 0;  ///< about the vertical through `at`
  double scale = 1;         ///< metres per unit of the file
  std::vector<MeshPiece> pieces;
};

using Fixture = std::variant<Gondola, Freezer, Box, MeshFixture>;

struct Room {
  Vec3 size;  ///< m
  /// Materials of the walls at x = 0, x = size, y = 0, y = size, of the floor and of the ceiling.
  std::array<MaterialId, 6> materials{};
};

struct TransceiverGrid {
  Vec2 min{}, max{};
  double spacing =
      1;  ///< m; stretched a little where it does not divide the extent, so both ends are included
  double z = 0;
  Vec3 axis{0, 0, -1};
  double roll_deg = 0;
  TransceiverTypeId type;
};

struct KeepOut {
  Vec2 min{}, max{};
};

/// Something listed in the file, and the place where it stands ("labels[3]", "labels.csv:5") for messages.
template <class T>
struct Listed {
  T value;
  std::string where;
};

/// A store file as written, names resolved to indices, tables and meshes loaded.
struct Store {
  std::string file;  ///< for messages
  std::string name;
  double wavelength_nm = 940;
  std::optional<Room> room;
  std::vector<NamedMaterial> materials;
  std::vector<LabelType> label_types;
  std::vector<TransceiverType> transceiver_types;
  std::vector<Listed<Fixture>> fixtures;
  std::vector<Listed<Label>> labels;
  std::vector<TransceiverGrid> grids;
  std::vector<Listed<Transceiver>> transceivers;
  std::vector<KeepOut> keep_out;
  std::vector<Listed<std::string>> installed;
  /// Bytes that a scene of it may take (StoreTrust::memory).
  std::size_t memory = StoreTrust{}.memory;
};

/// Of the store file (its key "format").
inline constexpr int store_format_version = 1;

/// Reads a store file (docs/formats/store.md) and the CSV and mesh files it names, relative to its folder.
/// Throws InputError with file and JSON path.
Store read_store(const std::filesystem::path& path, const StoreTrust& trust = {});

/// As above, from a text; `folder` is where named files are looked for.
Store parse_store(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const StoreTrust& trust = {});

/// Expands fixtures and grids, checks ids and positions, and freezes the result. Throws InputError.
Scene make_scene(const Store& store);

/// The store with nothing left to look up: labels and candidates listed, meshes inlined. Reading it back
/// gives the same scene to the bit; its content hash identifies the store in result files.
std::string resolved_store_json(const Store& store, const Scene& scene);

}  // namespace shelfbeam
