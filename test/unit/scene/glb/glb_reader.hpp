#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam::test {

using Json = nlohmann::ordered_json;

/// The chunks of a GLB file.
struct Glb {
  Json json;
  std::string binary;
};

template <class T>
T value_in(const std::string& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Reads a file that is correct.
inline Glb read_glb(const std::string& bytes) {
  const std::size_t length = value_in<std::uint32_t>(bytes, 12);
  return {Json::parse(bytes.substr(20, length)), bytes.substr(20 + length + 8)};
}

/// The values of an accessor, `components` per element. Throws std::exception if they are not in the buffer.
template <class T>
std::vector<T> values_of(const Glb& glb, std::size_t accessor, std::size_t components) {
  const Json& about = glb.json.at("accessors").at(accessor);
  const Json& view = glb.json.at("bufferViews").at(about.at("bufferView").get<std::size_t>());
  const std::size_t offset = about.at("byteOffset"),
                    size = sizeof(T) * components * about.at("count").get<std::size_t>();
  const std::string part =
      glb.binary.substr(view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
  std::vector<T> values(size / sizeof(T));
  if (offset % 4 != 0 || offset + size > part.size()) throw std::out_of_range("accessor");
  std::memcpy(values.data(), part.data() + offset, size);
  return values;
}

/// The triangles of a node in its own coordinates, z up.
using GlbNode = std::vector<std::array<Vec3, 3>>;

/// The children of the root node by their names.
inline std::map<std::string, GlbNode> nodes_of(const std::string& bytes) {
  const Glb glb = read_glb(bytes);
  std::map<std::string, GlbNode> nodes;
  for (const Json& child : glb.json.at("nodes").at(0).at("children")) {
    const Json& node = glb.json.at("nodes").at(child.get<std::size_t>());
    GlbNode& triangles = nodes[node.at("name")];
    if (!node.contains("mesh")) continue;
    for (const Json& primitive : glb.json.at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives")) {
      const auto p = values_of<float>(glb, primitive.at("attributes").at("POSITION"), 3);
      const auto indices = values_of<std::uint32_t>(glb, primitive.at("indices"), 1);
      const auto corner = [&](std::size_t k) {
        const std::size_t at = 3 * std::size_t{indices.at(k)};
        return Vec3{p.at(at), p.at(at + 1), p.at(at + 2)};
      };
      for (std::size_t k = 0; k < indices.size(); k += 3)
        triangles.push_back({corner(k), corner(k + 1), corner(k + 2)});
    }
  }
  return nodes;
}

/// Whether the stated bounds of a position accessor are exactly those of its positions.
inline bool has_bounds(const Glb& glb, std::size_t accessor) {
  const auto p = values_of<float>(glb, accessor, 3);
  const Json& about = glb.json["accessors"][accessor];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = p.at(axis), high = low;
    for (std::size_t k = axis; k < p.size(); k += 3) low = std::min(low, p[k]), high = std::max(high, p[k]);
    if (about.at("min").at(axis).get<double>() != low || about.at("max").at(axis).get<double>() != high)
      return false;
  }
  return about.at("type") == "VEC3" && about.at("componentType") == 5126;
}

/// Whether the indices of a primitive are triangles of its own vertices, all of which they use.
inline bool has_indices(const Glb& glb, const Json& primitive) {
  const Json& about = glb.json["accessors"].at(primitive.at("indices").get<std::size_t>());
  const auto indices = values_of<std::uint32_t>(glb, primitive.at("indices"), 1);
  const auto vertices = values_of<float>(glb, primitive.at("attributes").at("POSITION"), 3).size() / 3;
  std::vector<bool> used(vertices, false);
  for (const std::uint32_t index : indices) {
    if (index >= vertices) return false;
    used[index] = true;
  }
  return !indices.empty() && indices.size() % 3 == 0 &&
         std::find(used.begin(), used.end(), false) == used.end() && about.at("type") == "SCALAR" &&
         about.at("componentType") == 5125 && primitive.at("material") < glb.json.at("materials").size();
}

/// The first rule of the format that a file violates, in a word; empty if it is correct.
inline std::string problem_of(const std::string& bytes) {
  const auto number = [&](std::size_t at) { return value_in<std::uint32_t>(bytes, at); };
  if (bytes.size() < 28 || !bytes.starts_with("glTF") || number(4) != 2) return "header";
  if (number(8) != bytes.size() || bytes.size() % 4 != 0) return "length";
  const std::size_t json = number(12), binary = 20 + json;
  if (number(16) != 0x4E4F534A || json % 4 != 0 || binary + 8 > bytes.size()) return "JSON chunk";
  if (number(binary + 4) != 0x004E4942 || binary + 8 + number(binary) != bytes.size()) return "binary chunk";
  const Glb glb = read_glb(bytes);
  if (glb.json.at("buffers").at(0).at("byteLength") != glb.binary.size()) return "buffer";
  for (const Json& view : glb.json.at("bufferViews")) {
    const std::size_t offset = view.at("byteOffset"), length = view.at("byteLength");
    if (offset % 4 != 0 || offset + length > glb.binary.size()) return "buffer view";
  }
  for (const Json& mesh : glb.json.at("meshes"))
    for (const Json& primitive : mesh.at("primitives")) {
      if (!has_bounds(glb, primitive.at("attributes").at("POSITION"))) return "bounds";
      if (!has_indices(glb, primitive)) return "index";
    }
  return "";
}

}  // namespace shelfbeam::test
