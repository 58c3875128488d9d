#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/mesh/gltf_file.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

/// An affine map: the images of the three axes and of the origin.
struct Placement {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3 direction(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin; }
  Placement of(const Placement& inner) const {
    return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
  }
};

Vec3 vector_at(const JsonCursor& cursor) {
  const auto v = cursor.numbers(3);
  return {v[0], v[1], v[2]};
}

Placement placement_of(const JsonCursor& node) {
  if (const auto matrix = node.find("matrix")) {
    const auto m = matrix->numbers(16);
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  Placement placement;
  if (const auto rotation = node.find("rotation")) {
    const auto q = rotation->numbers(4);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    placement.x = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    placement.y = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    placement.z = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
  }
  if (const auto scale = node.find("scale")) {
    const Vec3 s = vector_at(*scale);
    placement.x = placement.x * s.x;
    placement.y = placement.y * s.y;
    placement.z = placement.z * s.z;
  }
  if (const auto translation = node.find("translation")) placement.origin = vector_at(*translation);
  return placement;
}

class GltfReader {
 public:
  GltfReader(GltfFile file, MeshLines& lines, MeshTriangles& triangles)
      : file_(std::move(file)), lines_(lines), triangles_(triangles) {}

  void read() {
    const auto number = file_.root().find("scene");
    const JsonCursor scenes = file_.root()["scenes"];
    if (!number && scenes.size() == 0) scenes.fail("is empty", "export the file with a scene");
    const JsonCursor scene = number ? file_.item("scenes", *number) : scenes.element(0);
    if (const auto nodes = file_.root().find("nodes")) seen_.resize(nodes->size(), false);
    struct Waiting {
      JsonCursor number;
      Placement parent;
    };
    std::vector<Waiting> waiting;
    const auto add = [&](const JsonCursor& owner, std::string_view key, const Placement& parent) {
      if (const auto nodes = owner.find(key)) {
        const auto numbers = nodes->elements();
        for (auto each = numbers.rbegin(); each != numbers.rend(); ++each) waiting.push_back({*each, parent});
      }
    };
    add(scene, "nodes", {});
    while (!waiting.empty()) {
      const auto [reference, parent] = waiting.back();
      waiting.pop_back();
      const JsonCursor node = file_.item("nodes", reference);
      const auto index = static_cast<std::size_t>(reference.number());
      // A node has only one parent, so the recursion ends.
      if (seen_[index]) reference.fail(fmt::format("names node {} twice", index), "export the file again");
      seen_[index] = true;
      const Placement placement = parent.of(placement_of(node));
      if (const auto mesh = node.find("mesh")) add_mesh(file_.item("meshes", *mesh), placement);
      add(node, "children", placement);
    }
  }

 private:
  void add_mesh(const JsonCursor& mesh, const Placement& placement) {
    for (const JsonCursor& primitive : mesh["primitives"].elements()) {
      const auto mode = primitive.find("mode");
      const std::int64_t kind = mode ? mode->integer(0, 6) : 4;
      const auto accessor = primitive["attributes"].find("POSITION");
      if (kind < 4 || !accessor) continue;  // points and lines
      std::vector<Vec3> positions = file_.positions(*accessor);
      for (Vec3& p : positions) {
        p = placement.point(p);
        if (!is_finite(p)) lines_.fail_file("has a node that makes a vertex infinite");
      }
      triangles_.use(material_of(primitive));
      const auto indices = primitive.find("indices");
      if (indices) {
        const std::vector<std::uint32_t> numbers = file_.indices(*indices, positions.size());
        add_triangles(kind, numbers.size(), [&](std::size_t k) { return positions[numbers[k]]; });
      } else {
        add_triangles(kind, positions.size(), [&](std::size_t k) { return positions[k]; });
      }
    }
  }

  std::string material_of(const JsonCursor& primitive) const {
    const auto number = primitive.find("material");
    if (!number) return {};
    const auto name = file_.item("materials", *number).find("name");
    return name ? name->text() : "";
  }

  // A list, a strip or a fan.
  template <class Corner>
  void add_triangles(std::int64_t kind, std::size_t count, Corner corner) {
    constexpr std::int64_t list = 4, strip = 5;
    for (std::size_t k = 0; k + 2 < count; k += kind == list ? 3 : 1) {
      const std::size_t odd = kind == strip ? k % 2 : 0;
      const std::size_t first = kind == list || kind == strip ? k + odd : 0;
      const std::size_t second = kind == list || kind == strip ? k + 1 - odd : k + 1;
      lines_.require_added(triangles_.add({corner(first), corner(second), corner(k + 2)}), 3);
    }
  }

  GltfFile file_;
  MeshLines& lines_;
  MeshTriangles& triangles_;
  std::vector<bool> seen_;
};

}  // namespace

void read_gltf(MeshLines& lines, const std::filesystem::path& name, const StoreFolder& folder,
               MeshTriangles& triangles) {
  try {
    GltfReader(GltfFile(lines.rest(), name, folder), lines, triangles).read();
  } catch (const InputError& refused) {
    // Adds the location in the store file to an error inside the mesh.
    if (refused.where() == lines.where()) throw;
    throw InputError(lines.where(),
                     fmt::format("the mesh '{}' cannot be read ({})", name.string(), refused.what()));
  }
}

}  // namespace shelfbeam
