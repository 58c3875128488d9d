#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

// The names stand for values at 940 nm; spectra of diffuse surfaces change little over the line of an LED.
constexpr double library_nm = 940, library_reach_nm = 20;

const NamedReflectance& named_reflectance(const JsonCursor& cursor, double wavelength_nm) {
  const std::string name = cursor.text();
  std::vector<std::string_view> known;
  for (const NamedReflectance& entry : reflectances_940nm()) {
    known.push_back(entry.name);
    if (entry.name != name) continue;
    if (std::abs(wavelength_nm - library_nm) > library_reach_nm)
      cursor.fail(
          fmt::format("'{}' is known at {} nm, but the store is for {} nm", name, library_nm, wavelength_nm),
          "give its reflectance at that wavelength as a number");
    return entry;
  }
  cursor.fail(fmt::format("there is no reflectance '{}'", name), suggest(name, known));
}

double read_reflectance(const JsonCursor& cursor, double wavelength_nm) {
  if (cursor.is_string()) return named_reflectance(cursor, wavelength_nm).reflectance;
  const double value = cursor.non_negative();
  if (value > 1)
    cursor.fail(fmt::format("is {}: a surface cannot reflect more than it receives", value),
                "use a value from 0 to 1");
  return value;
}

double read_ior(const JsonCursor& material, double least = 1) {
  return material["ior"].number(least, 4);
}

// alpha along x and y; nothing for a smooth surface.
std::optional<std::array<double, 2>> read_roughness(const JsonCursor& material, bool has_directions) {
  constexpr double least = 0.001;
  const auto roughness = material.find("roughness");
  if (!roughness) return std::nullopt;
  if (roughness->is_array()) {
    if (!has_directions)
      roughness->fail("has two values, but the coat of plastic is the same in all directions",
                      "give one number");
    roughness->numbers(2);
    const auto values = roughness->elements();
    return std::array{values[0].number(least, 1), values[1].number(least, 1)};
  }
  const double alpha = roughness->number();
  if (alpha == 0) return std::nullopt;
  if (alpha < least || alpha > 1)
    roughness->fail(fmt::format("is {}, which is outside {} to 1", alpha, least),
                    "use a value in that range, or 0 for a smooth surface");
  return std::array{alpha, alpha};
}

Masking read_masking(const JsonCursor& cursor, FacetDistribution distribution, bool refracts) {
  const auto masking = cursor.choice<Masking>();
  if (masking == Masking::cook_torrance && refracts)
    cursor.fail("is only defined for reflection", "use 'smith'");
  if (masking == Masking::smith_rational && distribution == FacetDistribution::ggx)
    cursor.fail("approximates the masking of beckmann; ggx has its exact one",
                "use 'smith', or the distribution 'beckmann'");
  return masking;
}

FacetSampling read_sampling(const JsonCursor& cursor, FacetDistribution distribution) {
  const auto sampling = cursor.choice<FacetSampling>();
  if (sampling == FacetSampling::visible && distribution != FacetDistribution::ggx)
    cursor.fail("visible facets can only be sampled for ggx", "use 'all', or the distribution 'ggx'");
  return sampling;
}

struct FacetRules {
  bool has_directions = true, refracts = false;
};

// Nothing for a smooth surface.
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

template <class Model>
using As = std::type_identity<Model>;
using Json = nlohmann::ordered_json;

Json with_facets(Json json, const std::optional<Microfacets>& facets) {
  if (!facets) return json;
  if (facets->isotropic())
    json["roughness"] = facets->alpha_x;
  else
    json["roughness"] = {facets->alpha_x, facets->alpha_y};
  json["distribution"] = to_text(facets->distribution);
  json["masking"] = to_text(facets->masking);
  json["sampling"] = to_text(facets->sampling);
  return json;
}

// How each type of material is read, and the keys that it is written with beside "type".

Lambertian read(As<Lambertian>, const JsonCursor& cursor, double wavelength_nm) {
  cursor.expect_keys({"type", "reflectance", "reflectance_range"});
  return make_lambertian(read_reflectance(cursor["reflectance"], wavelength_nm));
}
Json keys(const Lambertian& m) {
  return {{"reflectance", m.reflectance}};
}

Conductor read(As<Conductor>, const JsonCursor& cursor, double) {
  cursor.expect_keys({"type", "eta", "k", "roughness", "distribution", "masking", "sampling"});
  const double eta = cursor["eta"].number(0, 100), k = cursor["k"].number(0, 100);
  if (eta == 0 && k == 0) cursor.fail("has eta and k of 0", "an ideal mirror is eta 0 and k 1");
  return make_conductor(eta, k, read_facets(cursor, {}));
}
Json keys(const Conductor& m) {
  return with_facets({{"eta", m.eta}, {"k", m.k}}, m.facets);
}

Plastic read(As<Plastic>, const JsonCursor& cursor, double wavelength_nm) {
  cursor.expect_keys({"type", "ior", "reflectance", "reflectance_range", "roughness", "distribution",
                      "masking", "sampling"});
  const double ior = read_ior(cursor);
  const double reflectance = read_reflectance(cursor["reflectance"], wavelength_nm);
  return make_plastic(ior, reflectance, read_facets(cursor, {.has_directions = false}));
}
Json keys(const Plastic& m) {
  return with_facets({{"ior", m.ior}, {"reflectance", m.reflectance}}, m.facets);
}

Dielectric read(As<Dielectric>, const JsonCursor& cursor, double) {
  cursor.expect_keys({"type", "ior", "roughness", "distribution", "masking", "sampling"});
  const auto facets = read_facets(cursor, {.refracts = true});
  return make_dielectric(read_ior(cursor, facets ? 1.01 : 1), facets);
}
Json keys(const Dielectric& m) {
  return with_facets({{"ior", m.ior}}, m.facets);
}

ThinDielectric read(As<ThinDielectric>, const JsonCursor& cursor, double) {
  cursor.expect_keys({"type", "ior", "thickness", "absorption_per_m"});
  const double ior = read_ior(cursor);
  const auto absorption = cursor.find("absorption_per_m"), thickness = cursor.find("thickness");
  if (absorption && !thickness) cursor.fail("has 'absorption_per_m', but no 'thickness'", "add it, in m");
  return make_thin_dielectric(ior, thickness ? thickness->number(0, 1) : 0,
                              absorption ? absorption->number(0, 1e6) : 0);
}
Json keys(const ThinDielectric& m) {
  return {{"ior", m.ior}, {"thickness", m.thickness}, {"absorption_per_m", m.absorption_per_m}};
}

template <class... Models>
Material read_one_of(const JsonCursor& cursor, double wavelength_nm, As<std::variant<Models...>>) {
  const std::string type = cursor["type"].choice({Models::type_name...});
  Material material;
  ((type == Models::type_name ? void(material = read(As<Models>{}, cursor, wavelength_nm)) : void()), ...);
  return material;
}

// The one that is given, else that of the named reflectance.
std::optional<std::array<double, 2>> read_range(const JsonCursor& cursor, const Material& material,
                                                double wavelength_nm) {
  const auto reflectance = given_reflectance(material);
  if (!reflectance) return std::nullopt;
  const auto range = cursor.find("reflectance_range");
  if (!range) {
    const JsonCursor value = cursor["reflectance"];
    return value.is_string() ? named_reflectance(value, wavelength_nm).range : std::nullopt;
  }
  const std::vector<double> ends = range->numbers(2);
  if (ends[0] < 0 || ends[1] > 1 || *reflectance < ends[0] || *reflectance > ends[1])
    range->fail(fmt::format("is from {} to {}, and the reflectance is {}", ends[0], ends[1], *reflectance),
                "give two values from 0 to 1, the lower first, with the reflectance between them");
  return std::array{ends[0], ends[1]};
}

}  // namespace

void read_materials(const JsonCursor& section, Store& store) {
  for (const auto& [name, cursor] : section.members()) {
    const Material material =
        made_at(cursor, [&, &c = cursor] { return read_one_of(c, store.wavelength_nm, As<Material>{}); });
    store.materials.push_back(
        {check_name(name, cursor.where()), material, read_range(cursor, material, store.wavelength_nm)});
  }
}

nlohmann::ordered_json resolved(const Material& material) {
  Json json{{"type", type_name(material)}};
  json.update(std::visit([](const auto& m) { return keys(m); }, material));
  return json;
}

}  // namespace shelfbeam
