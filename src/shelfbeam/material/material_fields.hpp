#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/fields/key_rules.hpp"
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
/// Checks that the values read from `json` fit together.
void check(const Material& material, const JsonCursor& json, const ReflectanceKeys& keys, KeyRules& rules);
/// The material with these values, for use. Throws std::invalid_argument from `make_NAME`.
Material prepared(const Material& material);

// Keys of several types.

/// A number, or a name from reflectances_940nm.hpp.
void describe_reflectance(Fields& f, double& reflectance, ReflectanceKeys& keys, std::string_view says);
void describe_ior(Fields& f, double& ior, std::string_view says);

struct FacetRules {
  bool has_directions = true, refracts = false;
};
/// The microfacets of a material; nothing for a smooth surface.
void describe_facets(Fields& f, std::optional<Microfacets>& facets, const FacetRules& rules);
void check_facets(const std::optional<Microfacets>& facets, const JsonCursor& json, KeyRules& rules);
std::optional<Microfacets> prepared_facets(const std::optional<Microfacets>& facets);

}  // namespace shelfbeam
