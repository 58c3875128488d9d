#include "serve/live/file_facts.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/scene/build/mesh_facts.hpp"
#include "shelfbeam/scene/store_folder.hpp"

#include "serve/project/project_file.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr double radian = std::numbers::pi / 180;
constexpr int step_deg = 5;

// Intensities from the axis to the opposite direction, relative to the largest, in four half-planes C.
Json shape_of(const DirectionTable& table, std::string_view type) {
  const double peak = *std::ranges::max_element(table.values());
  Json planes = Json::array();
  for (const int c : {0, 90, 180, 270}) {
    Json plane = Json::array();
    for (int gamma = 0; gamma <= 180; gamma += step_deg)
      plane.push_back(table.value(gamma * radian, c * radian) / peak);
    planes.push_back(std::move(plane));
  }
  return {{"type", type}, {"step_deg", step_deg}, {"planes", std::move(planes)}};
}

Json size_of(const MeshFacts& mesh) {
  Json materials = Json::array();
  for (const auto& [name, triangles] : mesh.materials)
    materials.push_back({{"name", name}, {"triangles", triangles}});
  const auto list = [](const Vec3& v) { return Json{v.x, v.y, v.z}; };
  return {{"lower", list(mesh.low)}, {"upper", list(mesh.high)}, {"materials", std::move(materials)}};
}

}  // namespace

Json facts_of_file(const fs::path& folder, const std::string& name, const StoreLimits& limits) {
  const std::string extension = lower_case(fs::path(name).extension().string());
  const StoreFolder store(folder, limits);
  const auto profile = [&] { return store.find(name, name, "emission profile").read(max_photometry_file); };
  if (extension == ".ies") return {{"photometry", shape_of(parse_ies(profile(), name), "ies")}};
  if (extension == ".ldt") return {{"photometry", shape_of(parse_eulumdat(profile(), name), "eulumdat")}};
  constexpr std::array<std::string_view, 5> meshes{".glb", ".gltf", ".obj", ".stl", ".ply"};
  if (std::ranges::find(meshes, extension) == meshes.end()) return Json::object();
  return {{"mesh", size_of(mesh_facts(folder, name, limits))}};
}

Json keep_with_facts(const fs::path& folder, std::string_view name, std::string_view content,
                     const StoreLimits& limits) {
  const ProjectFile kept = keep_file(folder, name, content);
  Json json{{"file", kept.name}};
  if (kept.width > 0) json.update({{"width", kept.width}, {"height", kept.height}});
  try {
    json.update(facts_of_file(folder, kept.name, limits));
  } catch (const InputError&) {
    std::error_code ignored;
    if (kept.is_new) fs::remove(folder / kept.name, ignored);
    throw;
  }
  return json;
}

}  // namespace shelfbeam::serve
