#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

// Materials in store files (docs/formats/store/materials.md). Each type describes its own keys.

/// The wavelength for which a reflectance may have a name, and the range of the reflectance: as given,
/// otherwise that of the name, if any.
struct ReflectanceKeys {
  double wavelength_nm = 940;
  std::optional<std::array<double, 2>> range;
};

/// An empty material of each type.
const std::vector<Material>& material_types();
/// That of the type with a name. Throws InputError for an unknown type.
Material material_of_type(const JsonCursor& type);

void describe(Material& material, Fields& f, ReflectanceKeys& keys);
/// The material with the values read from `json`, prepared for use. Throws InputError with the JSON path if
/// the values do not fit together, or std::invalid_argument from `make_NAME`.
Material completed(const Material& material, const JsonCursor& json, const ReflectanceKeys& keys);

// Keys of several types.

/// A number, or a name from reflectances_940nm.hpp.
void describe_reflectance(Fields& f, double& reflectance, ReflectanceKeys& keys, std::string_view says);
void describe_ior(Fields& f, double& ior, std::string_view says);

struct FacetRules {
  bool has_directions = true, refracts = false;
};
/// The microfacets of a material; nothing for a smooth surface.
void describe_facets(Fields& f, std::optional<Microfacets>& facets, const FacetRules& rules);
std::optional<Microfacets> completed(const std::optional<Microfacets>& facets, const JsonCursor& json);

}  // namespace shelfbeam
