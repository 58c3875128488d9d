#include "shelfbeam/base/finding/finding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace shelfbeam {

namespace {

struct Words {
  FindingCode code;
  std::string_view name, subject = {};
};
constexpr auto all_words = std::to_array<Words>({
    {FindingCode::invalid, "invalid"},
    {FindingCode::wrong_kind, "wrong_kind"},
    {FindingCode::missing_key, "missing_key"},
    {FindingCode::unknown_key, "unknown_key"},
    {FindingCode::outside_limits, "outside_limits"},
    {FindingCode::unknown_name, "unknown_name"},
    {FindingCode::changed_ids, "changed_ids", "files with changed ids"},
    {FindingCode::text_encoding, "text_encoding", "files in guessed encodings"},
    {FindingCode::fixture_outside_room, "fixture_outside_room", "fixtures that extend outside the room"},
    {FindingCode::fixture_overlap, "fixture_overlap", "fixtures that overlap others"},
    {FindingCode::fixture_floating, "fixture_floating", "fixtures that float"},
    {FindingCode::rotation_in_radians, "rotation_in_radians", "rotations in radians"},
    {FindingCode::mesh_remark, "mesh_remark", "remarks about mesh files"},
    {FindingCode::mesh_open, "mesh_open", "open surfaces of solid dielectrics"},
    {FindingCode::mesh_inside_out, "mesh_inside_out", "surfaces of solid dielectrics that were inside out"},
    {FindingCode::mesh_repeated, "mesh_repeated", "surfaces of solid dielectrics that were listed twice"},
    {FindingCode::mesh_large, "mesh_large", "meshes above 200 m"},
    {FindingCode::mesh_zero_area, "mesh_zero_area", "meshes with triangles of zero area"},
    {FindingCode::mesh_twice, "mesh_twice", "meshes at the same place"},
    {FindingCode::mesh_size, "mesh_size", "meshes of an unusual size"},
    {FindingCode::device_outside_room, "device_outside_room", "devices that extend outside the room"},
    {FindingCode::label_inside_fixture, "label_inside_fixture", "labels inside a fixture"},
    {FindingCode::label_hidden, "label_hidden", "labels that are partly hidden"},
    {FindingCode::label_faces_surface, "label_faces_surface",
     "labels that face a surface right in front of them"},
    {FindingCode::label_sideways, "label_sideways", "labels that are turned sideways"},
    {FindingCode::label_in_mid_air, "label_in_mid_air", "labels in mid-air"},
    {FindingCode::label_twice, "label_twice", "labels at one place"},
    {FindingCode::label_height, "label_height", "labels at an unusual height"},
    {FindingCode::label_faces_floor, "label_faces_floor", "labels that face the floor"},
    {FindingCode::label_without_aisle, "label_without_aisle", "labels without an aisle"},
    {FindingCode::label_separated, "label_separated", "labels behind closed walls"},
    {FindingCode::unit_inside_fixture, "unit_inside_fixture", "transceivers inside a fixture"},
    {FindingCode::unit_hidden, "unit_hidden", "transceivers that are partly hidden"},
    {FindingCode::unit_outside, "unit_outside", "transceivers outside all surfaces"},
    {FindingCode::unit_faces_surface, "unit_faces_surface", "transceivers aimed at a surface"},
    {FindingCode::unit_faces_ceiling, "unit_faces_ceiling", "transceivers aimed at the ceiling"},
    {FindingCode::unit_height, "unit_height", "transceivers at an unusual height"},
    {FindingCode::unit_twice, "unit_twice", "candidates that are listed twice"},
    {FindingCode::unit_separated, "unit_separated", "transceivers behind closed walls"},
    {FindingCode::mount_empty, "mount_empty", "mounting areas without candidates"},
    {FindingCode::keep_out_outside, "keep_out_outside", "keep-out areas outside the shop"},
    {FindingCode::unusual_value, "unusual_value", "unusual values"},
    {FindingCode::material_bright, "material_bright", "materials that reflect almost all light"},
    {FindingCode::material_dark, "material_dark", "materials that reflect almost nothing"},
    {FindingCode::material_unused, "material_unused", "materials that nothing uses"},
    {FindingCode::type_unused, "type_unused", "types that nothing uses"},
    {FindingCode::requirement, "requirement", "requirements that every unit or none meets"},
    {FindingCode::requirement_ratio, "requirement_ratio", "unequal requirements"},
    {FindingCode::flux_ratio, "flux_ratio", "unequal flux"},
    {FindingCode::label_size, "label_size", "unusual sizes of labels"},
    {FindingCode::label_response, "label_response", "unusual responses of labels"},
    {FindingCode::emission_direction, "emission_direction", "unusual directions of emission"},
    {FindingCode::flux, "flux", "unusual flux"},
    {FindingCode::unit_free, "unit_free", "units that cost nothing"},
    {FindingCode::room_height, "room_height", "unusual heights of rooms"},
    {FindingCode::room_open, "room_open", "buildings that are open"},
    {FindingCode::wavelength, "wavelength", "unusual wavelengths"},
    {FindingCode::overlap_unchecked, "overlap_unchecked", "overlaps that were not checked"},
    {FindingCode::place_unchecked, "place_unchecked", "places that were not checked"},
    {FindingCode::labels_out_of_reach, "labels_out_of_reach"},
    {FindingCode::labels_flooded, "labels_flooded"},
    {FindingCode::other, "other"},
});

const Words& words_of(FindingCode code) {
  return *std::find_if(all_words.begin(), all_words.end(),
                       [&](const Words& words) { return words.code == code; });
}

}  // namespace

std::string_view name_of(FindingCode code) {
  return words_of(code).name;
}

std::string_view subject_of(FindingCode warning) {
  return words_of(warning).subject;
}

std::vector<std::string_view> warning_names() {
  std::vector<std::string_view> names;
  for (const Words& words : all_words)
    if (!words.subject.empty()) names.push_back(words.name);
  return names;
}

std::optional<FindingCode> finding_code(std::string_view name) {
  const auto* found = std::find_if(all_words.begin(), all_words.end(),
                                   [&](const Words& words) { return words.name == name; });
  return found == all_words.end() ? std::nullopt : std::optional(found->code);
}

std::optional<FindingCode> warning_of(std::string_view name) {
  const auto code = finding_code(name);
  return code && !subject_of(*code).empty() ? code : std::nullopt;
}

std::vector<std::string> sentences(const std::vector<Finding>& findings) {
  std::vector<std::string> result;
  result.reserve(findings.size());
  for (const Finding& finding : findings) result.push_back(finding.sentence);
  return result;
}

}  // namespace shelfbeam
