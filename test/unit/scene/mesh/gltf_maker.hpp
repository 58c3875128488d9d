#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "unit/scene/mesh_files.hpp"

namespace shelfbeam::test {

/// A glTF file with one mesh, the tetrahedron of mesh_files.hpp, in node 0 of its scene.
class GltfMaker {
 public:
  GltfMaker() {
    file = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "materials":[{"name":"m"}],"accessors":[],"bufferViews":[],"meshes":[{"primitives":[{"material":0}]}]})"_json;
    std::vector<float> positions;
    for (const auto& triangle : tetrahedron())
      for (const Corner& corner : triangle) positions.insert(positions.end(), corner.begin(), corner.end());
    file["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = add("VEC3", 3, positions);
  }

  Json& node(std::size_t k) { return file["nodes"][k]; }
  Json& primitive() { return file["meshes"][0]["primitives"][0]; }
  Json& extension(std::size_t node, const char* name) { return file["nodes"][node]["extensions"][name]; }

  /// A new buffer view of these numbers.
  template <class T>
  std::size_t view(const std::vector<T>& values) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t begin = bytes_.size();
    for (const T& value : values) bytes_ += bytes_of(value);
    file["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}});
    return file["bufferViews"].size() - 1;
  }
  /// A new accessor of these numbers; returns its index.
  template <class T>
  std::size_t add(const char* type, std::size_t components, const std::vector<T>& values,
                  bool normalized = false) {
    constexpr int kind = sizeof(T) == 4 ? 5126 : sizeof(T) == 2 ? 5123 : std::is_signed_v<T> ? 5120 : 5121;
    file["accessors"].push_back({{"bufferView", view(values)},
                                 {"componentType", kind},
                                 {"count", values.size() / components},
                                 {"type", type},
                                 {"normalized", normalized}});
    return file["accessors"].size() - 1;
  }

  /// The data of the buffer.
  const std::string& bytes() const { return bytes_; }
  /// The file; its buffer is in it, or in a file of its own.
  std::string text(std::string uri = "") const {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string padded = bytes_, base64;
    while (padded.size() % 3 != 0) padded += '\0';
    for (std::size_t k = 0; k < padded.size(); k += 3) {
      std::uint32_t group = 0;
      for (std::size_t i = 0; i < 3; ++i) group = group << 8 | static_cast<unsigned char>(padded[k + i]);
      for (int shift = 18; shift >= 0; shift -= 6) base64 += digits[group >> shift & 63];
    }
    Json complete = file;
    if (uri.empty()) uri = "data:;base64," + base64;
    complete["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", uri}}};
    return complete.dump();
  }
  Scene scene() const { return read_mesh("a.gltf", text()); }

  Json file;

 private:
  std::string bytes_;
};

}  // namespace shelfbeam::test
