#pragma once

#include <array>
#include <optional>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

// The object of a material in store files (docs/formats/store.md). Each type reads and writes its own keys.
// Reading throws InputError with the JSON path, or std::invalid_argument as `make_NAME` does.

Material read_material(const JsonCursor& json, double wavelength_nm);

/// As the resolved store has it; read back it is the same to the bit.
nlohmann::ordered_json resolved(const Material& material);

/// Between which values the reflectance may lie: as given, else as the named reflectance has it.
std::optional<std::array<double, 2>> read_reflectance_range(const JsonCursor& json, const Material& material,
                                                            double wavelength_nm);

/// A number, or a name of reflectances_940nm.hpp.
double read_reflectance(const JsonCursor& cursor, double wavelength_nm);
double read_ior(const JsonCursor& material, double least = 1);

struct FacetRules {
  bool has_directions = true, refracts = false;
};
/// The microfacets of a material; nothing for a smooth surface.
std::optional<Microfacets> read_facets(const JsonCursor& material, const FacetRules& rules);

struct MaterialWriter {
  nlohmann::ordered_json json;

  /// The keys of microfacets, if there are any.
  void add(const std::optional<Microfacets>& facets);
};

}  // namespace shelfbeam
