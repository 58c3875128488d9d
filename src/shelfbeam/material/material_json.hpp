#pragma once

#include <array>
#include <optional>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

// Materials in store files (docs/formats/store/materials.md). Each type reads and writes its own keys. All
// readers throw InputError with the JSON path, or std::invalid_argument from `make_NAME`.

Material read_material(const JsonCursor& json, double wavelength_nm);

/// The object for the resolved store. Reading it back gives the same material to the bit.
nlohmann::ordered_json resolved(const Material& material);

/// The range of the reflectance: as given, otherwise the range of the named reflectance, if any.
std::optional<std::array<double, 2>> read_reflectance_range(const JsonCursor& json, const Material& material,
                                                            double wavelength_nm);

/// A number, or a name from reflectances_940nm.hpp.
double read_reflectance(const JsonCursor& cursor, double wavelength_nm);
double read_ior(const JsonCursor& material, double min = 1);

struct FacetRules {
  bool has_directions = true, refracts = false;
};
/// The microfacets of a material; nothing for a smooth surface.
std::optional<Microfacets> read_facets(const JsonCursor& material, const FacetRules& rules);

struct MaterialWriter {
  nlohmann::ordered_json json;

  /// Adds the keys of the microfacets, if any.
  void add(const std::optional<Microfacets>& facets);
};

}  // namespace shelfbeam
