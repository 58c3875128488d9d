#include <cstdint>
#include <cstring>

#include "shelfbeam/scene/mesh/mesh_import.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

// A file name with the extension of the mesh format that the bytes belong to.
const char* name_of(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (bytes.starts_with("glTF")) return "mesh.glb";
  if (bytes.starts_with("{")) return "mesh.gltf";
  if (bytes.starts_with("ply")) return "mesh.ply";
  if (bytes.starts_with("solid") || (bytes.size() >= 84 && bytes.starts_with("STL"))) return "mesh.stl";
  return "mesh.obj";
}

void fuzz_mesh(std::string_view bytes) {
  constexpr std::size_t memory = 1 << 28;
  scratch().write(name_of(bytes), bytes);
  import_mesh(name_of(bytes), StoreFolder(scratch().path(), {false, memory}), std::nullopt,
              {{"*", MaterialId{0}}}, "store.json");
}

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

constexpr float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
constexpr std::int32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

// A binary file whose header states `count` facets.
std::string binary_stl(std::uint32_t count = 4) {
  std::string file = "STL";
  file.resize(80, ' ');
  file += bytes_of(count);
  for (const auto& face : faces) {
    file += std::string(12, '\0');
    for (const std::int32_t corner : face) file += bytes_of(corners[corner]);
    file += std::string(2, '\0');
  }
  return file;
}

std::string ply(bool binary) {
  std::string file =
      std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
      " 1.0\ncomment made\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  if (!binary) return file + "0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  for (const auto& corner : corners) file += bytes_of(corner);
  for (const auto& face : faces) file += '\3' + bytes_of(face);
  return file;
}

// The tetrahedron with a skin, a morph target, copies, and sparse positions.
std::string moved_gltf() {
  // Three vertices, joints and weights, a shift, the sparse vertex and its value.
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_gpu_instancing","KHR_node_visibility","ACME_x"],"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0},{"scale":[-1,1,2],"mesh":0,"weights":[0.5],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}},"KHR_node_visibility":{"visible":true}}}],"skins":[{"joints":[0,1]}],"meshes":[{"weights":[1],"primitives":[{"mode":5,"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"targets":[{"POSITION":3}]}]}],"buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEAAAABAAAAAQAA/wAAAH+AAAAA/wAAAQAAAA==","byteLength":64}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":4}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},{"bufferView":2,"componentType":5121,"count":3,"type":"VEC4","normalized":true},{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":0,"byteOffset":12}}}]})";
}

std::vector<std::string> mesh_seeds() {
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nvt 0 0\nvn 0 0 1\no a\ng b c\nusemtl x\ns 1\nf 1/1/1 3//1 2\nf -4 "
      "-3 -1\nl 1 2\np 3\n";
  const std::string stl =
      "solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 0\nendloop\nendfacet\n"
      "endsolid s\n";
  std::vector<std::string> all = {
      source_file("examples/grocery/checkout.glb"), source_file("examples/chiller/security-mirror.obj"), obj,
      stl, binary_stl(), ply(false), ply(true),
      // Dialects: comments behind data, one line, bytes behind facets, no count.
      "v 0 0 0 # a\nv 1 0 0#b\nv 0 2 \\\n0\nusemtl x #1 # c\nfo 1 2 3 # d \\\n",
      "solid s\nfacet outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 2 0 endloop endfacet endsolid",
      binary_stl() + "behind", binary_stl(0), moved_gltf(),
      // A triangle; indices 0 1 2, then three corners.
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"scale":[1,2,1]},{"mesh":0,"translation":[1,0,0]}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":1},"indices":0,"material":0}]}],"materials":[{"name":"x"}],"buffers":[{"uri":"data:application/octet-stream;base64,AAABAAIAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA=","byteLength":44}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":6,"target":34963},{"buffer":0,"byteOffset":8,"byteLength":36,"target":34962}],"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5123,"count":3,"type":"SCALAR","max":[2],"min":[0]},{"bufferView":1,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3","max":[1,1,0],"min":[0,0,0]}]})"};
  for (const std::string& text : {obj, stl, ply(false)})
    for (const std::string& foreign : foreign_texts(text)) all.push_back(foreign);
  return all;
}

// Corrects the lengths of a GLB file: of the file, and of the first chunk if it exceeds the file.
void repair_mesh(std::string& bytes) {
  if (!bytes.starts_with("glTF") || bytes.size() < 20) return;
  const auto set = [&](std::size_t at, std::size_t length) {
    const auto value = static_cast<std::uint32_t>(length);
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  set(8, bytes.size());
  std::uint32_t first = 0;
  std::memcpy(&first, bytes.data() + 12, sizeof first);
  if (first > bytes.size() - 20) set(12, bytes.size() - 20);
}

}  // namespace

extern const Reader mesh;
const Reader mesh{"mesh", fuzz_mesh, mesh_seeds, repair_mesh};

}  // namespace shelfbeam::fuzz
