#pragma once

namespace shelfbeam {

/// Share of unpolarised light that a smooth boundary reflects (2.32, in the index forms of its R_s and R_p).
/// `cos_i` in [0, 1] is the cosine to the normal, `eta` = n_t / n_i > 0; 1 under total internal reflection.
double fresnel_dielectric(double cos_i, double eta);

/// The same for a conductor with the complex index eta + i k, seen from air.
double fresnel_conductor(double cos_i, double eta, double k);

}  // namespace shelfbeam
