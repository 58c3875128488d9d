#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "shelfbeam/material/conductor.hpp"
#include "shelfbeam/material/dielectric.hpp"
#include "shelfbeam/material/lambertian.hpp"
#include "shelfbeam/material/plastic.hpp"
#include "shelfbeam/material/thin_dielectric.hpp"

namespace shelfbeam {

/// The closed set of surface models. To add a model, write a struct with the members of `Lambertian` and add
/// it here. Its functions are called only with wo.z > 0: the functions below handle the other side, by
/// `from_below` if the model differs from below. `reflectance` and `with_reflectance` are optional, but only
/// together.
using Material = std::variant<Lambertian, Conductor, Plastic, Dielectric, ThinDielectric>;

// Directions have unit length, point away from the surface and are given in its local frame: +z is the
// triangle's geometric normal, which points out of a closed solid. Opaque materials and panes are the same
// from both sides; a solid dielectric has its index below and air above.
//
// A walk comes from direction `wo` and continues in direction `wi`. Light leaves in direction `wo` if the
// walk started at a label, and arrives from `wo` if it started at a transceiver. Both walks use the same
// functions, because they carry basic radiance: radiance over the square of the index of its medium. The
// kernel of basic radiance is symmetric; with f_hat = f / n_leaving^2,
//
//     eval(wo, wi) = f_hat n_wi^2,    eval(a, b) / n_b^2 = eval(b, a) / n_a^2.
//
// In air the two radiances are equal. Only `sample` covers specular lobes (mirrors, smooth refraction).

/// f_r(wo, wi) in 1/sr (2.5), refraction included; 0 for directions that the material does not scatter to.
double eval(const Material& material, const Vec3& wo, const Vec3& wi);
/// Density per solid angle with which `sample` draws `wi`. Its integral is 1 minus the probabilities of
/// absorption and of the specular lobes.
double pdf(const Material& material, const Vec3& wo, const Vec3& wi);
/// Draws a direction from three uniform random numbers in [0, 1); nothing when the light is absorbed.
std::optional<ScatterSample> sample(const Material& material, const Vec3& wo, double u_lobe, double u1,
                                    double u2);
/// Share of the power from direction `wo` that is reflected or transmitted. Rough conductors and dielectrics
/// integrate numerically, which takes some milliseconds.
double albedo(const Material& material, const Vec3& wo);
/// Share of the power from direction `wo` that the specular lobe reflects.
double specular_reflectance(const Material& material, const Vec3& wo);
/// Whether `eval` is always 0, so that no connection to the surface carries light.
bool has_only_specular(const Material& material);
/// Whether the surface transmits no light.
bool is_opaque(const Material& material);

/// Whether the surface is a whole pane without thickness, on both sides of which is air.
bool is_pane(const Material& material);
/// Share of the light that passes a pane on a straight connection. Precondition: it is a pane.
double pane_transmittance(const Material& pane, double cos_theta);
/// The shares that a pane reflects and transmits, from either side. Precondition: it is a pane.
PaneShares pane_shares(const Material& pane, double cos_theta);
/// Whether the surface bounds a clear solid, so that its inside must be known.
bool is_solid(const Material& material);

/// The reflectance given in a store file: of a diffuse surface, or of the base under a coat. Nothing for
/// other materials, whose reflectance follows from their indices.
std::optional<double> given_reflectance(const Material& material);
/// The same material with another given reflectance, 0 to 1. A rough coat is tabulated again, which takes
/// some milliseconds. Throws std::invalid_argument for a material without a given reflectance.
Material with_reflectance(const Material& material, double reflectance);

/// The name used in the store file.
std::string_view type_name(const Material& material);

}  // namespace shelfbeam
