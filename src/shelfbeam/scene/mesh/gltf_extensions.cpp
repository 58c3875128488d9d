#include "shelfbeam/scene/mesh/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

// The extensions in the registry of Khronos and some in wide use. A name that ends with '*' stands for all
// that begin so.

// The program applies these.
constexpr auto applied = std::to_array<std::string_view>(
    {"EXT_mesh_gpu_instancing", "KHR_mesh_quantization", "KHR_node_visibility"});

// They compress data that the file also contains without compression, unless it requires the extension.
constexpr auto compressions = std::to_array<std::string_view>(
    {"EXT_meshopt_compression", "KHR_draco_mesh_compression", "KHR_meshopt_compression"});

// They concern materials, lights, sound, behaviour, physics or names, and leave the surfaces as they are.
// Levels of detail and variants of a mesh or a material add coarser or other ones to those in the scene.
constexpr auto harmless = std::to_array<std::string_view>({"ADOBE_materials_*",
                                                           "AGI_stk_metadata",
                                                           "BENTLEY_materials_*",
                                                           "CESIUM_primitive_outline",
                                                           "EXT_feature_metadata",
                                                           "EXT_instance_features",
                                                           "EXT_lights_*",
                                                           "EXT_mesh_features",
                                                           "EXT_mesh_manifold",
                                                           "EXT_mesh_polygon",
                                                           "EXT_mesh_primitive_edge_visibility",
                                                           "EXT_structural_metadata",
                                                           "EXT_texture_*",
                                                           "FB_geometry_metadata",
                                                           "FB_ngon_encoding",
                                                           "GODOT_single_root",
                                                           "GRIFFEL_bim_data",
                                                           "KHR_animation*",
                                                           "KHR_audio*",
                                                           "KHR_avatar*",
                                                           "KHR_character*",
                                                           "KHR_collision_shapes",
                                                           "KHR_data_sizes",
                                                           "KHR_environment_map",
                                                           "KHR_implicit_shapes",
                                                           "KHR_interactivity",
                                                           "KHR_lights*",
                                                           "KHR_materials_*",
                                                           "KHR_node_hoverability",
                                                           "KHR_node_selectability",
                                                           "KHR_physics_rigid_bodies",
                                                           "KHR_rigid_bodies",
                                                           "KHR_techniques_webgl",
                                                           "KHR_texture_*",
                                                           "KHR_xmp*",
                                                           "MAXAR_mesh_variants",
                                                           "MOZ_*",
                                                           "MSFT_audio_emitter",
                                                           "MSFT_lod",
                                                           "MSFT_packing_*",
                                                           "MSFT_texture_*",
                                                           "NV_materials_mdl",
                                                           "OMI_*",
                                                           "SHAPESPARK_*",
                                                           "VRM",
                                                           "VRMC_*"});

// They move or add surfaces, or store positions in another way.
constexpr auto changing = std::to_array<std::string_view>(
    {"AGI_articulations", "BENTLEY_primitive_restart", "CESIUM_RTC", "CESIUM_tile_edges", "EXT_implicit_*",
     "EXT_mesh_primitive_restart", "EXT_primitive_voxels", "KHR_accessor_float*", "KHR_billboard",
     "KHR_gaussian_splatting*", "KHR_instancing", "KHR_mesh_primitive_restart", "MPEG_*",
     "WEB3D_quantized_attributes"});

template <class List>
bool has(const List& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(),
                     [&](std::string_view entry) { return matches_glob(name, entry); });
}

}  // namespace

GltfExtensions::GltfExtensions(const JsonCursor& root) {
  for (const char* key : {"extensionsRequired", "extensionsUsed"})
    if (const auto names = root.find(key))
      for (const JsonCursor& name : names->elements())
        check_name(name.text(), key == std::string_view("extensionsRequired"), name);
}

void GltfExtensions::check(const JsonCursor& object) {
  if (const auto extensions = object.find("extensions"))
    for (const auto& [name, value] : extensions->members()) check_name(name, false, value);
}

void GltfExtensions::check_name(const std::string& name, bool is_required, const JsonCursor& place) {
  if (has(applied, name) || has(harmless, name) || (!is_required && has(compressions, name))) return;
  if (is_required || has(changing, name))
    place.fail(fmt::format("{} the unsupported {}", is_required ? "requires" : "uses", in_quotes(name)),
               "export the file without it");
  unknown_.insert(name);
}

}  // namespace shelfbeam
