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

/// The closed set of surface models. To add one, write a struct with the members of `Lambertian` and name it
/// here; its directions have known.z > 0, the functions below take care of the other side, by `from_below`
/// where a model has it and it differs. `reflectance` and `with_reflectance` go together; a model without
/// them has no reflectance of its own.
using Material = std::variant<Lambertian, Conductor, Plastic, Dielectric, ThinDielectric>;

// Directions are unit, point away from the surface and are in its local frame: +z is the triangle's geometric
// normal, the outside of a closed solid. Opaque materials and panes are the same from both sides; a solid
// dielectric has its index below and air above.
//
// `known` is where a walk comes from, `sampled` where it goes on: from the label, `known` is the direction in
// which the light leaves; from a transceiver, the one from which it arrives. Both use the same functions, for
// what is carried is basic radiance, which is radiance over the square of the index where it travels. Its
// kernel is symmetric; with f_hat = f / n_leaving^2,
//
//     eval(known, sampled) = f_hat n_sampled^2,    eval(a, b) / n_b^2 = eval(b, a) / n_a^2.
//
// In air nothing changes. Specular lobes (mirrors, smooth refraction) are only met by `sample`.

/// f_r(known, sampled) in 1/sr (2.5), refraction included; 0 where there is none.
double eval(const Material& material, const Vec3& known, const Vec3& sampled);
/// Density per solid angle with which `sample` draws `sampled`. Its integral is 1 less the probabilities of
/// drawing nothing and of the specular lobes.
double pdf(const Material& material, const Vec3& known, const Vec3& sampled);
/// Draws a direction from three numbers uniform in [0, 1); nothing when the light is absorbed.
std::optional<ScatterSample> sample(const Material& material, const Vec3& known, double u_lobe, double u1,
                                    double u2);
/// Share of the power from direction `known` that is reflected or transmitted. Rough conductors and
/// dielectrics integrate: some milliseconds.
double albedo(const Material& material, const Vec3& known);
/// Share of the power from direction `known` that is reflected as by a mirror.
double specular_reflectance(const Material& material, const Vec3& known);
/// Whether `eval` is always 0: no connection to such a surface carries anything.
bool has_only_specular(const Material& material);
/// Whether no light gets to the other side.
bool is_opaque(const Material& material);

/// The reflectance that a store file gives: of a diffuse surface, or of the base under a coat. Nothing for
/// the others, whose reflectance follows from their indices.
std::optional<double> given_reflectance(const Material& material);
/// The same material with another such reflectance, 0 to 1. A rough coat is tabulated anew: some
/// milliseconds. Throws std::invalid_argument where there is none.
Material with_reflectance(const Material& material, double reflectance);

/// The name used in the store file.
std::string_view type_name(const Material& material);

}  // namespace shelfbeam
