#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

Vec2 read_plan_point(const JsonCursor& cursor) {
  const auto v = cursor.numbers(2);
  return {v[0], v[1]};
}

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

double optional_number(const JsonCursor& cursor, const char* key, double fallback) {
  const auto found = cursor.find(key);
  return found ? found->number() : fallback;
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
  labels.spacing = (*cursor)["spacing"].positive();
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

Gondola read_gondola(const JsonCursor& c, const std::string& id, const StoreNames& names) {
  c.expect_keys({"type", "id", "at", "length", "depth", "height", "rotation_deg", "material", "goods",
                 "shelves", "stocking", "faces", "labels"});
  Gondola g;
  g.id = id;
  g.at = read_plan_point(c["at"]);
  g.rotation_deg = optional_number(c, "rotation_deg", 0);
  g.length = c["length"].positive();
  g.depth = c["depth"].positive();
  g.height = c["height"].positive();
  if (g.depth < 0.1) c["depth"].fail("is below 0.1 m", "a back panel and a board need that much");
  g.material = names.material(c["material"]);
  const auto goods = c.find("goods");
  g.goods = goods ? names.material(*goods) : g.material;
  for (const JsonCursor& shelf : c["shelves"].elements()) {
    const double z = shelf.positive();
    if (z >= g.height)
      shelf.fail(fmt::format("is at {} m, not below the height {} m", z, g.height), "lower it");
    if (z < 0.05) shelf.fail(fmt::format("is at {} m", z), "boards stand at 0.05 m or higher");
    if (!g.shelves.empty() && z < g.shelves.back() + 0.05)
      shelf.fail("is not at least 0.05 m above the board before it",
                 "list the boards from the lowest to the highest");
    g.shelves.push_back(z);
  }
  g.stocking = read_stocking(c);
  const auto faces = c.find("faces");
  g.faces = faces ? read_faces(*faces, false) : std::vector{Face::front, Face::back};
  g.labels = read_fixture_labels(c, names, g.faces, false);
  if (g.labels && g.shelves.empty())
    c["labels"].fail("has no boards to stand on", "give the fixture shelves");
  return g;
}

Freezer read_freezer(const JsonCursor& c, const std::string& id, const StoreNames& names) {
  c.expect_keys({"type", "id", "at", "length", "depth", "height", "rotation_deg", "material", "goods",
                 "stocking", "labels"});
  Freezer f;
  f.id = id;
  f.at = read_plan_point(c["at"]);
  f.rotation_deg = optional_number(c, "rotation_deg", 0);
  f.length = c["length"].positive();
  f.depth = c["depth"].positive();
  f.height = c["height"].positive();
  for (const char* key : {"length", "depth", "height"})
    if (c[key].number() < 0.3) c[key].fail("is below 0.3 m", "a tub needs that much");
  f.material = names.material(c["material"]);
  const auto goods = c.find("goods");
  f.goods = goods ? names.material(*goods) : f.material;
  f.stocking = read_stocking(c);
  f.labels = read_fixture_labels(c, names, {Face::front, Face::back}, true);
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
    for (const JsonCursor& vertex : part["vertices"].elements()) piece.vertices.push_back(read_point(vertex));
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

MeshFixture read_mesh(const JsonCursor& c, const std::string& id, const StoreNames& names,
                      const std::filesystem::path& folder) {
  c.expect_keys({"type", "id", "file", "parts", "at", "rotation_deg", "scale", "up", "materials"});
  MeshFixture m;
  m.id = id;
  m.at = read_point(c["at"]);
  m.rotation_deg = optional_number(c, "rotation_deg", 0);
  if (const auto scale = c.find("scale")) m.scale = scale->positive();
  if (const auto parts = c.find("parts")) {
    if (c.find("file")) c.fail("has both 'file' and 'parts'", "keep one of them");
    m.pieces = read_inline_pieces(*parts, names);
    return m;
  }
  const JsonCursor file = c["file"];
  const std::filesystem::path path = folder / file.text();
  // glTF defines y as up; the other formats say nothing, and z is what building tools write.
  bool y_is_up = path.extension() == ".gltf" || path.extension() == ".glb";
  if (const auto up = c.find("up")) y_is_up = up->choice({"y", "z"}) == "y";
  std::vector<std::pair<std::string, MaterialId>> map;
  for (const auto& [pattern, name] : c["materials"].members())
    map.emplace_back(pattern, names.material(name));
  m.pieces = import_mesh(path, y_is_up, map, file.where());
  return m;
}

}  // namespace

void read_fixtures(const JsonCursor& section, const StoreNames& names, const std::filesystem::path& folder,
                   Store& store) {
  for (const JsonCursor& cursor : section.elements()) {
    const std::string type = cursor["type"].choice({"gondola", "freezer", "box", "mesh"});
    const std::string id = cursor["id"].text();
    if (id.empty()) cursor["id"].fail("is empty", "give the fixture a name");
    Fixture fixture = type == "gondola"   ? Fixture(read_gondola(cursor, id, names))
                      : type == "freezer" ? Fixture(read_freezer(cursor, id, names))
                      : type == "box"     ? Fixture(read_box(cursor, id, names))
                                          : Fixture(read_mesh(cursor, id, names, folder));
    store.fixtures.push_back({std::move(fixture), cursor.where()});
  }
}

}  // namespace shelfbeam
