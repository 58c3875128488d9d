#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/scene/room_shape.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

class Fields;
class JsonCursor;
class Problems;
struct StoreNames;

/// The room of a store file: its shape and the materials of its surfaces.
struct Room {
  RoomShape shape;
  MaterialId floor, ceiling;
  /// By edge of the outline: wall k runs from corner k to corner k + 1. For a box y0, x1, y1, x0.
  std::vector<MaterialId> walls;
  MaterialId usual_wall;  ///< of holes, and of inner walls without a material

  struct ZoneMaterials {
    MaterialId ceiling, fascia;
  };
  std::vector<ZoneMaterials> zones;  ///< by zone of the shape

  struct WallMaterials {
    MaterialId wall;
    std::vector<std::optional<MaterialId>> panes;  ///< by opening
  };
  std::vector<WallMaterials> inner_walls;  ///< by inner wall of the shape

  std::vector<std::optional<MaterialId>> openings;  ///< by row of the shape: of panes and door leaves

  static Room box(const Vec3& size, MaterialId material);

  void fields(Fields& f);
  // Describe member `k` of a list; if `k` is its size, append an empty member first.
  void zone_fields(Fields& f, std::size_t k);
  void inner_wall_fields(Fields& f, std::size_t k);
  void opening_fields(Fields& f, std::size_t wall, std::size_t k);
  void outer_opening_fields(Fields& f, std::size_t k);

 private:
  void box_walls(Fields& f);
  void outline_walls(Fields& f);
};

/// The keys of `repeat` of an opening in an outer wall.
void describe_repeat(OpeningRow& row, Fields& f);

/// Collects the problems of the room, and returns nothing if there are any.
std::optional<Room> read_room(const JsonCursor& json, const StoreNames& names, Problems& problems);

struct TriangleRange {
  std::uint32_t first = 0, count = 0;
};

/// Adds an inner wall's outline and parts for drawings, which are solid between its openings. `surface` is
/// the wall's range of triangles.
void add_wall_parts(const Room& room, std::size_t wall, const TriangleRange& surface, Scene& scene);

/// Throws InputError for a solid dielectric, because a pane has no thickness.
void expect_pane(const NamedMaterial& material, const std::string& where);

/// The same for the openings in outer walls of a store file.
void expect_outer_panes(const Room& room, std::span<const NamedMaterial> materials, const std::string& file);

/// Adds the surfaces of the room to an empty mesh. They form a closed surface: triangles meet vertex to
/// vertex, also where ceilings of different heights, inner walls and openings meet. Walls and
/// ceilings face away from the air, floors upwards, except in a plain box. Returns the triangles of each
/// inner wall.
std::vector<TriangleRange> add_shell(const Room& room, TriangleMesh& mesh);

}  // namespace shelfbeam
