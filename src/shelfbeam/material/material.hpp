#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Ideal diffuse reflection, f_r = rho / pi (2.21).
struct Lambertian {
  double reflectance = 0;  ///< rho, the hemispherical reflectance at the store's wavelength, in [0, 1]
};

/// The closed set of surface models. To add one: give it a struct above and a case in each function of
/// material.cpp; the compiler names what is missing.
using Material = std::variant<Lambertian>;

/// A sampled direction: `weight` = f_r cos(theta) / pdf.
struct ScatterSample {
  Vec3 direction;
  double weight = 0;
  double pdf = 0;
};

// Directions are unit, point away from the surface, and are in its local frame, whose +z lies on the side of
// `outgoing`; every surface is two-sided.

/// f_r(incoming, outgoing) in 1/sr (2.5); 0 where a direction is below the surface.
double eval(const Material& material, const Vec3& outgoing, const Vec3& incoming);
/// Density per solid angle with which `sample` draws `incoming`.
double pdf(const Material& material, const Vec3& outgoing, const Vec3& incoming);
/// Draws an incoming direction from two uniform numbers; nothing when all light is absorbed.
std::optional<ScatterSample> sample(const Material& material, const Vec3& outgoing, double u1, double u2);
/// Share of the power from direction `outgoing` that is reflected.
double albedo(const Material& material, const Vec3& outgoing);

/// The name used in the store file.
std::string_view type_name(const Material& material);

}  // namespace shelfbeam
