#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace shelfbeam {

/// The codes of problems of a store, of warnings about it, and of warnings about a plan.
enum class FindingCode : std::uint8_t {
  invalid,
  wrong_kind,
  missing_key,
  unknown_key,
  outside_limits,
  unknown_name,
  changed_ids,
  text_encoding,
  fixture_outside_room,
  fixture_overlap,
  fixture_floating,
  rotation_in_radians,
  mesh_remark,
  mesh_open,
  mesh_inside_out,
  mesh_repeated,
  mesh_large,
  mesh_zero_area,
  mesh_twice,
  mesh_size,
  device_outside_room,
  label_inside_fixture,
  label_hidden,
  label_faces_surface,
  label_sideways,
  label_in_mid_air,
  label_twice,
  label_height,
  label_faces_floor,
  label_without_aisle,
  label_separated,
  unit_inside_fixture,
  unit_hidden,
  unit_outside,
  unit_faces_surface,
  unit_faces_ceiling,
  unit_height,
  unit_twice,
  unit_separated,
  mount_empty,
  keep_out_outside,
  unusual_value,
  material_bright,
  material_dark,
  material_unused,
  type_unused,
  requirement,
  requirement_ratio,
  flux_ratio,
  label_size,
  label_response,
  emission_direction,
  flux,
  unit_free,
  room_height,
  room_open,
  wavelength,
  overlap_unchecked,
  place_unchecked,
  labels_out_of_reach,
  labels_flooded,
  other,  ///< as an earlier version of the program worded it
};
/// Its name in files.
std::string_view name_of(FindingCode code);
std::optional<FindingCode> finding_code(std::string_view name);
/// The names of all codes of warnings about a store, for the key "ignore".
std::vector<std::string_view> warning_names();
/// The warning about a store with this name.
std::optional<FindingCode> warning_of(std::string_view name);
/// Completes "and 123 more".
std::string_view subject_of(FindingCode warning);

/// The numbers and names in the sentence of a finding, in its order. For a value outside its limits: the
/// value and the limits.
using FindingValue = std::variant<double, std::string>;
using FindingValues = std::vector<FindingValue>;

/// A problem of a store, or a warning about it.
struct Finding {
  FindingCode code = FindingCode::invalid;
  std::string path;  ///< of the element in the store file ("fixtures[3].depth"), or the line of a CSV file
  FindingValues values;
  std::string sentence;  ///< for a store, with the name of the file

  bool operator==(const Finding&) const = default;
};

/// The sentences of findings.
std::vector<std::string> sentences(const std::vector<Finding>& findings);

}  // namespace shelfbeam
