#include "shelfbeam/material/material_json.hpp"

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"

namespace shelfbeam {

namespace {

// Named values hold at 940 nm. Spectra of diffuse surfaces change little within the bandwidth of an LED.
constexpr double library_nm = 940, library_reach_nm = 20;

const NamedReflectance& named_reflectance(const JsonCursor& cursor, double wavelength_nm) {
  const std::string name = cursor.text();
  std::vector<std::string_view> known;
  for (const NamedReflectance& entry : reflectances_940nm()) {
    known.push_back(entry.name);
    if (entry.name != name) continue;
    if (std::abs(wavelength_nm - library_nm) > library_reach_nm)
      cursor.fail(fmt::format("'{}' is a reflectance at {} nm, but the store is for {} nm", name, library_nm,
                              wavelength_nm),
                  "give the reflectance at that wavelength as a number");
    return entry;
  }
  cursor.fail(fmt::format("names the unknown reflectance {}", in_quotes(name)), suggest(name, known));
}

// alpha along x and y; nothing for a smooth surface.
std::optional<std::array<double, 2>> read_roughness(const JsonCursor& material, bool has_directions) {
  constexpr double min = 0.001;
  const auto roughness = material.find("roughness");
  if (!roughness) return std::nullopt;
  if (roughness->is_array()) {
    if (!has_directions)
      roughness->fail("has two values, but the coat of plastic is isotropic", "give one number");
    roughness->numbers(2);
    const auto values = roughness->elements();
    return std::array{values[0].number(min, 1), values[1].number(min, 1)};
  }
  const double alpha = roughness->number();
  if (alpha == 0) return std::nullopt;
  if (alpha < min || alpha > 1)
    roughness->fail(fmt::format("is {}, which is outside {} to 1", alpha, min),
                    "use a value in that range, or 0 for a smooth surface");
  return std::array{alpha, alpha};
}

Masking read_masking(const JsonCursor& cursor, FacetDistribution distribution, bool refracts) {
  const auto masking = cursor.choice<Masking>();
  if (masking == Masking::cook_torrance && refracts)
    cursor.fail("is only defined for reflection", "use 'smith'");
  if (masking == Masking::smith_rational && distribution == FacetDistribution::ggx)
    cursor.fail("approximates the masking of beckmann only", "use 'smith', or the distribution 'beckmann'");
  return masking;
}

FacetSampling read_sampling(const JsonCursor& cursor, FacetDistribution distribution) {
  const auto sampling = cursor.choice<FacetSampling>();
  if (sampling == FacetSampling::visible && distribution != FacetDistribution::ggx)
    cursor.fail("visible facets can only be sampled for ggx", "use 'all', or the distribution 'ggx'");
  return sampling;
}

template <class... Models>
Material read_one_of(const JsonCursor& json, double wavelength_nm,
                     std::type_identity<std::variant<Models...>>) {
  const std::string type = json["type"].choice({Models::type_name...});
  Material material;
  ((type == Models::type_name ? void(material = Models::read(json, wavelength_nm)) : void()), ...);
  return material;
}

}  // namespace

double read_reflectance(const JsonCursor& cursor, double wavelength_nm) {
  if (cursor.is_string()) return named_reflectance(cursor, wavelength_nm).reflectance;
  const double value = cursor.non_negative();
  if (value > 1)
    cursor.fail(fmt::format("is {}: a surface cannot reflect more than it receives", value),
                "use a value from 0 to 1");
  return value;
}

std::optional<std::array<double, 2>> read_reflectance_range(const JsonCursor& cursor,
                                                            const Material& material, double wavelength_nm) {
  const auto reflectance = given_reflectance(material);
  if (!reflectance) return std::nullopt;
  const auto range = cursor.find("reflectance_range");
  if (!range) {
    const JsonCursor value = cursor["reflectance"];
    return value.is_string() ? named_reflectance(value, wavelength_nm).range : std::nullopt;
  }
  const std::vector<double> ends = range->numbers(2);
  if (ends[0] < 0 || ends[1] > 1 || *reflectance < ends[0] || *reflectance > ends[1])
    range->fail(fmt::format("is {} to {}, but the reflectance is {}", ends[0], ends[1], *reflectance),
                "give two values from 0 to 1, the lower first, with the reflectance between them");
  return std::array{ends[0], ends[1]};
}

double read_ior(const JsonCursor& material, double min) {
  return material["ior"].number(min, 4);
}

std::optional<Microfacets> read_facets(const JsonCursor& material, const FacetRules& rules) {
  const auto alpha = read_roughness(material, rules.has_directions);
  if (!alpha) {
    for (const char* key : {"distribution", "masking", "sampling"})
      if (const auto idle = material.find(key))
        idle->fail("has no effect on a smooth surface", "remove it, or give a 'roughness' above 0");
    return std::nullopt;
  }
  const auto name = material.find("distribution");
  const auto distribution = name ? name->choice<FacetDistribution>() : FacetDistribution::ggx;
  Microfacets facets = make_microfacets(distribution, (*alpha)[0], (*alpha)[1]);
  if (const auto masking = material.find("masking"))
    facets.masking = read_masking(*masking, distribution, rules.refracts);
  if (const auto sampling = material.find("sampling"))
    facets.sampling = read_sampling(*sampling, distribution);
  return make_microfacets(distribution, facets.alpha_x, facets.alpha_y, facets.masking, facets.sampling);
}

void MaterialWriter::add(const std::optional<Microfacets>& facets) {
  if (!facets) return;
  if (facets->isotropic())
    json["roughness"] = facets->alpha_x;
  else
    json["roughness"] = {facets->alpha_x, facets->alpha_y};
  json["distribution"] = to_text(facets->distribution);
  json["masking"] = to_text(facets->masking);
  json["sampling"] = to_text(facets->sampling);
}

Material read_material(const JsonCursor& json, double wavelength_nm) {
  return read_one_of(json, wavelength_nm, std::type_identity<Material>{});
}

nlohmann::ordered_json resolved(const Material& material) {
  MaterialWriter writer;
  writer.json["type"] = type_name(material);
  std::visit([&](const auto& m) { m.write(writer); }, material);
  return writer.json;
}

}  // namespace shelfbeam
