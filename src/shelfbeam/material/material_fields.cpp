#include "shelfbeam/material/material_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/describe_choice.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

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

template <class... Models>
std::vector<Material> samples(std::type_identity<std::variant<Models...>>) {
  return {Models{}...};
}

// alpha along x and y; 0 for a smooth surface.
std::array<double, 2> read_roughness(const JsonCursor& roughness, bool has_directions) {
  constexpr double min = 0.001;
  if (roughness.is_array()) {
    if (!has_directions)
      roughness.fail("has two values, but the coat of plastic is isotropic", "give one number");
    roughness.numbers(2);
    return {roughness.element(0).number(min, 1), roughness.element(1).number(min, 1)};
  }
  const double alpha = roughness.number();
  if (alpha != 0 && (alpha < min || alpha > 1))
    roughness.fail(fmt::format("is {}, which is outside {} to 1", alpha, min),
                   "use a value in that range, or 0 for a smooth surface");
  return {alpha, alpha};
}

}  // namespace

const std::vector<Material>& material_types() {
  static const std::vector<Material> types = samples(std::type_identity<Material>{});
  return types;
}

Material material_of_type(const JsonCursor& type) {
  std::vector<std::string_view> names;
  for (const Material& one : material_types()) names.push_back(type_name(one));
  const std::string name = type.choice(names);
  return *std::ranges::find(material_types(), name, [](const Material& one) { return type_name(one); });
}

void describe(Material& material, Fields& f, ReflectanceKeys& keys) {
  const std::string_view says = std::visit([](const auto& one) { return one.says; }, material);
  const std::string schema = fmt::format(R"({{"const": "{}"}})", type_name(material));
  f.custom("type", {[](const JsonCursor&) {}, [&] { return Json(type_name(material)); }, schema},
           {.says = says});
  std::visit([&](auto& one) { one.fields(f, keys); }, material);
  if (!given_reflectance(material)) return;
  const CustomValue range{[&](const JsonCursor& json) {
                            const std::vector<double> ends = json.numbers(2);
                            keys.range = std::array{ends[0], ends[1]};
                          },
                          [&] { return Json(*keys.range); }, R"({"$ref": "#/$defs/reflectance_range"})"};
  f.custom("reflectance_range", range,
           {.says = "how accurately the reflectance is known: `[low, high]`",
            .is_optional = true,
            .otherwise = "that of the name",
            .is_written = keys.range.has_value()});
}

void check(const Material& material, const JsonCursor& json, const ReflectanceKeys& keys, KeyRules& rules) {
  rules.rule({"reflectance", "reflectance_range"}, [&] {
    const auto range = json.find("reflectance_range");
    const std::optional<double> reflectance = given_reflectance(material);
    if (!range || !reflectance) return;
    const auto [low, high] = *keys.range;
    if (low < 0 || high > 1 || *reflectance < low || *reflectance > high)
      range->fail(fmt::format("is {} to {}, but the reflectance is {}", low, high, *reflectance),
                  "give two values from 0 to 1, the lower first, with the reflectance between them");
  });
  std::visit([&](const auto& one) { one.check(json, rules); }, material);
}

Material prepared(const Material& material) {
  return std::visit([](const auto& one) { return Material(one.prepared()); }, material);
}

void describe_reflectance(Fields& f, double& reflectance, ReflectanceKeys& keys, std::string_view says) {
  const CustomValue value{
      [&](const JsonCursor& json) {
        if (json.is_string()) {
          const NamedReflectance& named = named_reflectance(json, keys.wavelength_nm);
          reflectance = named.reflectance;
          keys.range = named.range;
          return;
        }
        reflectance = json.non_negative();
        if (reflectance > 1)
          json.fail(fmt::format("is {}: a surface cannot reflect more than it receives", reflectance),
                    "use a value from 0 to 1");
      },
      [&] { return Json(reflectance); }, R"({"$ref": "#/$defs/reflectance"})"};
  f.custom("reflectance", value, {.says = says});
}

void describe_ior(Fields& f, double& ior, std::string_view says) {
  f.scalar("ior", Scalar::number, ior, {.says = says, .least = 1, .most = 4});
}

void describe_facets(Fields& f, std::optional<Microfacets>& facets, const FacetRules& rules) {
  const bool is_rough = facets.has_value();
  Microfacets values = facets.value_or(Microfacets{});
  const CustomValue roughness{
      [&](const JsonCursor& json) {
        const auto [x, y] = read_roughness(json, rules.has_directions);
        if (x == 0) return;
        values.alpha_x = x;
        values.alpha_y = y;
        facets = values;
      },
      [&] { return values.isotropic() ? Json(values.alpha_x) : Json{values.alpha_x, values.alpha_y}; },
      rules.has_directions ? R"({"$ref": "#/$defs/roughness"})" : R"({"$ref": "#/$defs/even_roughness"})"};
  f.custom("roughness", roughness,
           {.says = rules.has_directions
                        ? "alpha, 0.001 to 1 (for `beckmann` sqrt(2) times the rms slope), or [two "
                          "values](#roughness); 0 is smooth"
                        : "alpha, 0.001 to 1 (for `beckmann` sqrt(2) times the rms slope); 0 is smooth",
            .is_optional = true,
            .otherwise = "0",
            .is_written = is_rough});
  if (describe_choice<FacetDistribution>(f, "distribution", values.distribution, names_of<FacetDistribution>,
                                         {.says = "distribution of the facets: `ggx` or `beckmann`",
                                          .is_optional = true,
                                          .is_written = is_rough}))
    values.sampling =
        values.distribution == FacetDistribution::ggx ? FacetSampling::visible : FacetSampling::all;
  // The last model is only defined for reflection.
  describe_choice<Masking>(
      f, "masking", values.masking, std::span(names_of<Masking>).first(rules.refracts ? 2 : 3),
      {.says =
           rules.refracts
               ? "model of how facets hide each other: `smith`, or `smith_rational`, its approximation for "
                 "`beckmann`"
               : "model of how facets hide each other: `smith`; `smith_rational`, its approximation for "
                 "`beckmann`; or `cook_torrance`, which treats facets as grooves",
       .is_optional = true,
       .is_written = is_rough});
  describe_choice<FacetSampling>(
      f, "sampling", values.sampling, names_of<FacetSampling>,
      {.says = "sampling of facets: `visible` (the facets that a ray sees, `ggx` only) or `all`; affects the "
               "noise, not the result",
       .is_optional = true,
       .otherwise = "`\"visible\"`, for `beckmann` `\"all\"`",
       .is_written = is_rough});
  if (facets) facets = values;
}

void check_facets(const std::optional<Microfacets>& facets, const JsonCursor& json, KeyRules& rules) {
  for (const char* key : {"distribution", "masking", "sampling"})
    rules.rule({"roughness"}, [&] {
      const auto given = json.find(key);
      if (given && !facets)
        given->fail("has no effect on a smooth surface", "remove it, or give a 'roughness' above 0");
    });
  if (!facets) return;
  const bool is_ggx = facets->distribution == FacetDistribution::ggx;
  rules.rule({"distribution", "masking"}, [&] {
    if (facets->masking == Masking::smith_rational && is_ggx)
      json["masking"].fail("approximates the masking of beckmann only",
                           "use 'smith', or the distribution 'beckmann'");
  });
  rules.rule({"distribution", "sampling"}, [&] {
    if (facets->sampling == FacetSampling::visible && !is_ggx)
      json["sampling"].fail("visible facets can only be sampled for ggx",
                            "use 'all', or the distribution 'ggx'");
  });
}

std::optional<Microfacets> prepared_facets(const std::optional<Microfacets>& facets) {
  if (!facets) return {};
  return make_microfacets(facets->distribution, facets->alpha_x, facets->alpha_y, facets->masking,
                          facets->sampling);
}

}  // namespace shelfbeam
