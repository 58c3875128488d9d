#include "shelfbeam/material/optics/fresnel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace shelfbeam {

double fresnel_dielectric(double cos_i, double eta) {
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return 1;
  const double cos_t = std::sqrt(1 - sin2_t);
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (s * s + p * p) / 2;
}

double fresnel_conductor(double cos_i, double eta, double k) {
  const std::complex<double> n(eta, k);
  const std::complex<double> cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (n * n));
  const double s = std::norm((cos_i - n * cos_t) / (cos_i + n * cos_t));
  const double p = std::norm((n * cos_i - cos_t) / (n * cos_i + cos_t));
  return std::min(1.0, (s + p) / 2);
}

}  // namespace shelfbeam
