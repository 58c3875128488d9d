#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/gltf_extensions.hpp"
#include "shelfbeam/scene/mesh/gltf_file.hpp"
#include "shelfbeam/scene/mesh/gltf_placement.hpp"
#include "shelfbeam/scene/mesh/gltf_vertices.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

std::optional<JsonCursor> extension(const JsonCursor& object, const char* name) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

bool is_hidden(const JsonCursor& node) {
  const auto visibility = extension(node, "KHR_node_visibility");
  const auto visible = visibility ? visibility->find("visible") : std::nullopt;
  return visible && !visible->boolean();
}

class GltfReader {
 public:
  GltfReader(GltfFile file, MeshLines& lines, MeshTriangles& triangles)
      : file_(std::move(file)), extensions_(file_.root()), lines_(lines), triangles_(triangles) {}

  void read() {
    place_nodes();
    for (const auto& [node, index] : with_mesh_) add_mesh(node, index);
    for (const std::string& name : extensions_.unknown())
      triangles_.note(fmt::format("uses the unknown extension {}, which was ignored", in_quotes(name)));
  }

 private:
  // Computes the placements of the nodes of the scene, which joints require, and lists those with a mesh.
  void place_nodes() {
    const auto number = file_.root().find("scene");
    const JsonCursor scenes = file_.root()["scenes"];
    if (!number && scenes.size() == 0) scenes.fail("is empty", "export the file with a scene");
    const JsonCursor scene = number ? file_.item("scenes", *number) : scenes.element(0);
    extensions_.check(scene);
    if (const auto nodes = file_.root().find("nodes")) placements_.resize(nodes->size());
    struct Waiting {
      JsonCursor number;
      GltfPlacement parent;
      bool is_hidden;
    };
    std::vector<Waiting> waiting;
    const auto add = [&](const JsonCursor& owner, std::string_view key, const GltfPlacement& parent,
                         bool hidden) {
      if (const auto nodes = owner.find(key)) {
        const auto numbers = nodes->elements();
        for (auto each = numbers.rbegin(); each != numbers.rend(); ++each)
          waiting.push_back({*each, parent, hidden});
      }
    };
    add(scene, "nodes", {}, false);
    while (!waiting.empty()) {
      const Waiting next = waiting.back();
      waiting.pop_back();
      const JsonCursor node = file_.item("nodes", next.number);
      const auto index = static_cast<std::size_t>(next.number.number());
      // A node has only one parent, so the loop ends.
      if (placements_[index])
        next.number.fail(fmt::format("names node {} twice", index), "export the file again");
      extensions_.check(node);
      const GltfPlacement placement = next.parent.of(GltfPlacement::of_node(node));
      placements_[index] = placement;
      const bool hidden = next.is_hidden || is_hidden(node);
      if (node.find("mesh") && !hidden) with_mesh_.emplace_back(node, index);
      add(node, "children", placement, hidden);
    }
  }

  void add_mesh(const JsonCursor& node, std::size_t index) {
    const JsonCursor mesh = file_.item("meshes", node["mesh"]);
    extensions_.check(mesh);
    const std::vector<double> weights = morph_weights(node, mesh);
    const auto skin = node.find("skin");
    const auto instances = extension(node, instancing);
    if (skin && instances) instances->fail("applies to a mesh with a skin", "export the file without it");
    // Only its joints place a mesh with a skin.
    const std::vector<GltfPlacement> joints = skin ? joints_of(*skin) : std::vector<GltfPlacement>{};
    const std::vector<GltfPlacement> copies = skin        ? std::vector<GltfPlacement>(1)
                                              : instances ? copies_of(*placements_[index], *instances)
                                                          : std::vector{*placements_[index]};
    for (const JsonCursor& primitive : mesh["primitives"].elements()) {
      extensions_.check(primitive);
      const auto mode = primitive.find("mode");
      const std::int64_t kind = mode ? mode->integer(0, 6) : 4;
      const auto positions = primitive["attributes"].find("POSITION");
      if (kind < 4 || !positions) continue;  // points and lines
      expect_plain(primitive, *positions);
      const std::vector<Vec3> vertices = gltf_vertices(file_, primitive, weights, joints);
      note_single_precision(*positions);
      triangles_.use(material_of(primitive));
      const auto numbers = primitive.find("indices");
      std::vector<std::uint32_t> indices(numbers ? 0 : vertices.size());
      if (numbers)
        indices = file_.indices(*numbers, vertices.size());
      else
        std::iota(indices.begin(), indices.end(), 0U);
      if (kind == list && indices.size() % 3 != 0)
        primitive.fail(fmt::format("has {} corners, which is not three for each triangle", indices.size()),
                       "export the file again");
      for (const GltfPlacement& copy : copies) add_triangles(kind, copy, vertices, indices);
    }
  }

  void note_single_precision(const JsonCursor& accessor) {
    if (!file_.is_single(accessor)) return;
    Bounds bounds;
    for (const Vec3& p : file_.positions(accessor)) bounds.include(p);
    triangles_.note_single_precision(bounds);
  }

  // A file may contain the vertices of a compressed primitive without compression, too.
  void expect_plain(const JsonCursor& primitive, const JsonCursor& positions) const {
    const auto compressed = extension(primitive, "KHR_draco_mesh_compression");
    const JsonCursor accessor = file_.item("accessors", positions);
    if (compressed && !accessor.find("bufferView"))
      compressed->fail("is the only form of the vertices, and is not supported",
                       "export the file without it");
  }

  std::vector<GltfPlacement> joints_of(const JsonCursor& number) {
    const JsonCursor skin = file_.item("skins", number);
    extensions_.check(skin);
    std::vector<double> inverses;
    const auto accessor = skin.find("inverseBindMatrices");
    if (accessor) inverses = file_.numbers(*accessor, "MAT4");
    std::vector<GltfPlacement> joints;
    for (const JsonCursor& joint : skin["joints"].elements()) {
      file_.item("nodes", joint);
      const auto& placement = placements_[static_cast<std::size_t>(joint.number())];
      if (!placement) joint.fail("is a node outside the scene", "export the file again");
      joints.push_back(*placement);
      const std::size_t at = 16 * (joints.size() - 1);
      if (accessor && at + 16 > inverses.size())
        accessor->fail("has fewer elements than 'joints'", "export the file again");
      if (accessor)
        joints.back() = placement->of(GltfPlacement::from_matrix(inverses.data() + at, *accessor));
    }
    if (joints.empty()) skin["joints"].fail("is empty", "export the file again");
    return joints;
  }

  std::vector<GltfPlacement> copies_of(const GltfPlacement& node, const JsonCursor& instances) {
    const JsonCursor attributes = instances["attributes"];
    std::optional<std::size_t> count;
    const auto read = [&](const char* key, const char* type, std::size_t components) {
      std::vector<double> values;
      const auto accessor = attributes.find(key);
      if (!accessor) return values;
      values = file_.numbers(*accessor, type);
      if (count.value_or(values.size() / components) != values.size() / components)
        attributes.fail("have different numbers of elements", "export the file again");
      count = values.size() / components;
      return values;
    };
    const auto shifts = read("TRANSLATION", "VEC3", 3), turns = read("ROTATION", "VEC4", 4),
               scales = read("SCALE", "VEC3", 3);
    std::vector<GltfPlacement> copies;
    for (std::size_t k = 0; k < count.value_or(1); ++k) {
      const auto vector_at = [&](const std::vector<double>& values, double otherwise) {
        return values.empty() ? Vec3{otherwise, otherwise, otherwise}
                              : Vec3{values[3 * k], values[3 * k + 1], values[3 * k + 2]};
      };
      std::array<double, 4> turn{0, 0, 0, 1};
      for (std::size_t c = 0; c < turn.size() && !turns.empty(); ++c) turn[c] = turns[4 * k + c];
      if (turn == std::array<double, 4>{}) attributes.fail("have a zero quaternion", "export the file again");
      copies.push_back(node.of(GltfPlacement::from(vector_at(shifts, 0), turn, vector_at(scales, 1))));
    }
    return copies;
  }

  std::string material_of(const JsonCursor& primitive) const {
    const auto number = primitive.find("material");
    if (!number) return {};
    const auto name = file_.item("materials", *number).find("name");
    return name ? name->text() : "";
  }

  // A list, a strip or a fan.
  void add_triangles(std::int64_t kind, const GltfPlacement& placement, const std::vector<Vec3>& vertices,
                     const std::vector<std::uint32_t>& indices) {
    const auto corner = [&](std::size_t k) {
      const Vec3 p = placement.point(vertices[indices[k]]);
      if (!is_finite(p)) lines_.fail_file("has a node that makes a vertex infinite");
      return p;
    };
    for (std::size_t k = 0; k + 2 < indices.size(); k += kind == list ? 3 : 1) {
      const std::size_t odd = kind == strip ? k % 2 : 0;
      std::size_t first = kind == list || kind == strip ? k + odd : 0;
      std::size_t second = kind == list || kind == strip ? k + 1 - odd : k + 1;
      if (placement.mirrors()) std::swap(first, second);
      lines_.require_added(triangles_.add({corner(first), corner(second), corner(k + 2)}), 3);
    }
  }

  static constexpr std::int64_t list = 4, strip = 5;

  GltfFile file_;
  GltfExtensions extensions_;
  MeshLines& lines_;
  MeshTriangles& triangles_;
  std::vector<std::optional<GltfPlacement>> placements_;  ///< by node
  std::vector<std::pair<JsonCursor, std::size_t>> with_mesh_;
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
