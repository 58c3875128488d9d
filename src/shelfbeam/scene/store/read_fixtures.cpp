#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

Face read_face(const JsonCursor& cursor, bool with_ends) {
  const std::string name =
      with_ends ? cursor.choice({"front", "back", "left", "right"}) : cursor.choice({"front", "back"});
  return name == "front"  ? Face::front
         : name == "back" ? Face::back
         : name == "left" ? Face::left
                          : Face::right;
}

std::vector<Face> read_faces(const JsonCursor& cursor, bool with_ends) {
  std::vector<Face> faces;
  for (const JsonCursor& element : cursor.elements()) {
    const Face face = read_face(element, with_ends);
    if (std::find(faces.begin(), faces.end(), face) != faces.end())
      element.fail("stands twice", "remove one");
    faces.push_back(face);
  }
  if (faces.empty()) cursor.fail("is empty", "name at least one face, or leave the key out");
  return faces;
}

double read_rotation(const JsonCursor& cursor) {
  const auto found = cursor.find("rotation_deg");
  return found ? read_angle_deg(*found) : 0;
}

double read_stocking(const JsonCursor& cursor) {
  const auto found = cursor.find("stocking");
  return found ? found->number(0, 1) : 0.8;
}

std::optional<FixtureLabels> read_fixture_labels(const JsonCursor& fixture, const StoreNames& names,
                                                 const std::vector<Face>& available, bool with_ends) {
  const auto cursor = fixture.find("labels");
  if (!cursor) return std::nullopt;
  cursor->expect_keys({"type", "spacing", "faces", "tilt_deg"});
  FixtureLabels labels;
  labels.type = names.label_type((*cursor)["type"]);
  labels.spacing = read_length((*cursor)["spacing"]);
  if (const auto faces = cursor->find("faces")) {
    labels.faces = read_faces(*faces, with_ends);
    if (!with_ends)
      for (const Face face : labels.faces)
        if (std::find(available.begin(), available.end(), face) == available.end())
          faces->fail("names a face that has no boards", "see the fixture's own 'faces'");
  } else {
    labels.faces = available;
  }
  if (const auto tilt = cursor->find("tilt_deg")) labels.tilt_deg = tilt->number(-89, 89);
  return labels;
}

// `length` is the longest face of the fixture, m.
void expect_few(const std::optional<FixtureLabels>& labels, const JsonCursor& fixture, double length,
                std::size_t levels) {
  if (!labels) return;
  const double count = length / labels->spacing * static_cast<double>(levels * labels->faces.size());
  if (count > 1e6)
    fixture["labels"]["spacing"].fail(fmt::format("makes {:.0f} labels", count), "use a wider spacing");
}

// What all shelving has but its labels.
void read_shelving(const JsonCursor& c, const std::string& id, const StoreNames& names, Shelving& shelving) {
  shelving.id = id;
  shelving.at = read_plan_point(c["at"]);
  shelving.rotation_deg = read_rotation(c);
  shelving.length = read_length(c["length"]);
  shelving.depth = read_length(c["depth"]);
  shelving.height = read_length(c["height"]);
  shelving.material = names.material(c["material"]);
  const auto goods = c.find("goods");
  shelving.goods = goods ? names.material(*goods) : shelving.material;
  shelving.stocking = read_stocking(c);
  if (const auto doors = c.find("doors")) shelving.doors = names.material(*doors);
}

Gondola read_gondola(const JsonCursor& c, const std::string& id, const StoreNames& names) {
  c.expect_keys({"type", "id", "at", "length", "depth", "height", "rotation_deg", "material", "goods",
                 "doors", "shelves", "stocking", "faces", "labels"});
  Gondola g;
  read_shelving(c, id, names, g);
  if (g.depth < 0.1) c["depth"].fail("is below 0.1 m", "a back panel and a board need that much");
  if (g.doors && g.height < 0.3) c["height"].fail("is below 0.3 m", "a gondola with doors needs that much");
  for (const JsonCursor& shelf : c["shelves"].elements()) {
    const double z = read_length(shelf);
    if (z >= g.height)
      shelf.fail(fmt::format("is at {} m, not below the height {} m", z, g.height), "lower it");
    if (z < 0.05) shelf.fail(fmt::format("is at {} m", z), "boards stand at 0.05 m or higher");
    if (!g.shelves.empty() && z < g.shelves.back() + 0.05)
      shelf.fail("is not at least 0.05 m above the board before it",
                 "list the boards from the lowest to the highest");
    g.shelves.push_back(z);
  }
  if (g.shelves.size() > 50) c["shelves"].fail(fmt::format("has {} boards", g.shelves.size()), "50 at most");
  const auto faces = c.find("faces");
  g.faces = faces ? read_faces(*faces, false) : std::vector{Face::front, Face::back};
  g.labels = read_fixture_labels(c, names, g.faces, false);
  if (g.labels && g.shelves.empty())
    c["labels"].fail("has no boards to stand on", "give the fixture shelves");
  expect_few(g.labels, c, g.length, g.shelves.size());
  return g;
}

Freezer read_freezer(const JsonCursor& c, const std::string& id, const StoreNames& names) {
  c.expect_keys({"type", "id", "at", "length", "depth", "height", "rotation_deg", "material", "goods",
                 "doors", "stocking", "labels"});
  Freezer f;
  read_shelving(c, id, names, f);
  for (const char* key : {"length", "depth", "height"})
    if (c[key].number() < 0.3) c[key].fail("is below 0.3 m", "a tub needs that much");
  f.labels = read_fixture_labels(c, names, {Face::front, Face::back}, true);
  expect_few(f.labels, c, std::max(f.length, f.depth), 1);
  return f;
}

Box read_box(const JsonCursor& c, const std::string& id, const StoreNames& names) {
  c.expect_keys({"type", "id", "min", "max", "material"});
  Box b{id, read_point(c["min"]), read_point(c["max"]), names.material(c["material"])};
  for (int axis = 0; axis < 3; ++axis)
    if (b.max[axis] <= b.min[axis])
      c["max"].fail("is not above 'min' in every direction", "a box has a positive size");
  return b;
}

std::vector<MeshPiece> read_inline_pieces(const JsonCursor& parts, const StoreNames& names) {
  std::vector<MeshPiece> pieces;
  for (const JsonCursor& part : parts.elements()) {
    part.expect_keys({"name", "material", "vertices", "faces"});
    MeshPiece piece;
    piece.name = part["name"].text();
    piece.material = names.material(part["material"]);
    for (const JsonCursor& vertex : part["vertices"].elements()) {
      const auto v = vertex.numbers(3);
      piece.vertices.push_back({v[0], v[1], v[2]});
    }
    const auto last = static_cast<std::int64_t>(piece.vertices.size()) - 1;
    for (const JsonCursor& face : part["faces"].elements()) {
      const auto corners = face.elements();
      if (corners.size() != 3) face.fail("is no triangle", "give three vertex numbers");
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = static_cast<std::uint32_t>(corners[i].integer(0, std::max<std::int64_t>(last, 0)));
      piece.triangles.push_back(triangle);
    }
    if (piece.vertices.empty() || piece.triangles.empty()) part.fail("has no triangles", "remove it");
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) parts.fail("is empty", "give at least one part");
  return pieces;
}

std::vector<MeshPiece> read_mesh_file(const JsonCursor& c, const StoreNames& names,
                                      const StoreFolder& folder) {
  const JsonCursor file = c["file"];
  std::vector<std::pair<std::string, MaterialId>> map;
  for (const auto& [pattern, name] : c["materials"].members())
    map.emplace_back(pattern, names.material(name));
  std::optional<bool> y_is_up;
  if (const auto up = c.find("up")) y_is_up = up->choice({"y", "z"}) == "y";
  return import_mesh(file.text(), folder, y_is_up, map, file.where());
}

MeshFixture read_mesh(const JsonCursor& c, const std::string& id, const StoreNames& names,
                      const StoreFolder& folder) {
  const bool is_inline = c.find("parts").has_value();
  if (is_inline && c.find("file")) c.fail("has both 'file' and 'parts'", "keep one of them");
  if (is_inline)
    c.expect_keys({"type", "id", "parts", "at", "rotation_deg", "scale"});
  else
    c.expect_keys({"type", "id", "file", "at", "rotation_deg", "scale", "up", "materials"});
  MeshFixture m;
  m.id = id;
  m.at = read_point(c["at"]);
  m.rotation_deg = read_rotation(c);
  if (const auto scale = c.find("scale")) m.scale = read_quantity(*scale);
  m.pieces = is_inline ? read_inline_pieces(c["parts"], names) : read_mesh_file(c, names, folder);
  for (const MeshPiece& piece : m.pieces)
    for (const Vec3& vertex : piece.vertices)
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(vertex[axis] * m.scale) <= 1e4))
          c.fail(fmt::format("reaches {:.4g} m from its 'at'", std::abs(vertex[axis] * m.scale)),
                 "set 'scale' to the metres that a unit of the mesh stands for");
  return m;
}

}  // namespace

void read_fixtures(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                   Store& store) {
  for (const JsonCursor& cursor : section.elements()) {
    const std::string type = cursor["type"].choice({"gondola", "freezer", "box", "mesh"});
    const std::string id = read_name(cursor["id"]);
    Fixture fixture = type == "gondola"   ? Fixture(read_gondola(cursor, id, names))
                      : type == "freezer" ? Fixture(read_freezer(cursor, id, names))
                      : type == "box"     ? Fixture(read_box(cursor, id, names))
                                          : Fixture(read_mesh(cursor, id, names, folder));
    store.fixtures.push_back({std::move(fixture), cursor.where()});
  }
}

}  // namespace shelfbeam
