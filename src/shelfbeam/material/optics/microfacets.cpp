#include "shelfbeam/material/optics/microfacets.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// (alpha tan theta)^2 of a direction, with the alpha of its azimuth.
double stretched_tan2(const Microfacets& m, const Vec3& w) {
  const double x = m.alpha_x * w.x, y = m.alpha_y * w.y;
  return (x * x + y * y) / (w.z * w.z);
}

double smith_beckmann(double a, bool rational) {
  if (rational) return a < 1.6 ? (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a) : 1;
  return 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi)));
}

// Facet with slope `r` times alpha at azimuth `phi` of the stretched space, which makes both distributions
// isotropic.
Vec3 facet(const Microfacets& m, double r, double phi) {
  return normalized({m.alpha_x * r * std::cos(phi), m.alpha_y * r * std::sin(phi), 1});
}

// Heitz, "Sampling the GGX distribution of visible normals", JCGT 2018.
Vec3 sample_visible(const Microfacets& m, const Vec3& w, double u1, double u2) {
  const Vec3 v = normalized({m.alpha_x * w.x, m.alpha_y * w.y, w.z});
  const double across = std::hypot(v.x, v.y);
  const Vec3 t1 = across > 0 ? Vec3{-v.y / across, v.x / across, 0} : Vec3{1, 0, 0};
  const Vec3 t2 = cross(v, t1);
  const double r = std::sqrt(u1), p1 = r * std::cos(2 * pi * u2), s = (1 + v.z) / 2;
  const double p2 = (1 - s) * std::sqrt(std::max(0.0, 1 - p1 * p1)) + s * r * std::sin(2 * pi * u2);
  const Vec3 n = t1 * p1 + t2 * p2 + v * std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2));
  return normalized({m.alpha_x * n.x, m.alpha_y * n.y, std::max(1e-12, n.z)});
}

}  // namespace

double Microfacets::density(const Vec3& h) const {
  if (h.z <= 0) return 0;
  const double x = h.x / alpha_x, y = h.y / alpha_y, across2 = x * x + y * y, cos2 = h.z * h.z;
  const double scale = 1 / (pi * alpha_x * alpha_y);
  if (distribution == FacetDistribution::ggx) return scale / ((cos2 + across2) * (cos2 + across2));
  const double e = across2 / cos2;  // tan^2 theta_h (cos^2 phi / ax^2 + sin^2 phi / ay^2)
  return e < 700 ? scale * std::exp(-e) / (cos2 * cos2) : 0;
}

double Microfacets::masking_of(const Vec3& w, const Vec3& h) const {
  if (dot(w, h) * w.z <= 0) return 0;
  const double t2 = stretched_tan2(*this, w);
  if (t2 == 0) return 1;
  if (distribution == FacetDistribution::ggx) return 2 / (1 + std::sqrt(1 + t2));
  return smith_beckmann(1 / std::sqrt(t2), masking == Masking::smith_rational);
}

double Microfacets::shadowing(const Vec3& a, const Vec3& b, const Vec3& h) const {
  if (masking != Masking::cook_torrance) return masking_of(a, h) * masking_of(b, h);
  const double ah = dot(a, h);
  return ah > 0 ? std::clamp(2 * h.z * std::min(a.z, b.z) / ah, 0.0, 1.0) : 0;
}

Vec3 Microfacets::sample(const Vec3& w, double u1, double u2) const {
  if (sampling == FacetSampling::visible) return sample_visible(*this, w, u1, u2);
  // (2.33), (2.35): tan^2 in the stretched space
  const double e = distribution == FacetDistribution::beckmann ? -std::log1p(-u1) : u1 / (1 - u1);
  return facet(*this, std::sqrt(e), 2 * pi * u2);
}

double Microfacets::pdf(const Vec3& w, const Vec3& h) const {
  if (sampling == FacetSampling::all) return density(h) * h.z;
  return masking_of(w, h) * std::max(0.0, dot(w, h)) * density(h) / w.z;
}

double Microfacets::reflection(const Vec3& a, const Vec3& b, const Vec3& h) const {
  return density(h) * shadowing(a, b, h) / (4 * a.z * b.z);
}

double Microfacets::reflection_pdf(const Vec3& w, const Vec3& h) const {
  const double wh = dot(w, h);
  return wh > 0 ? pdf(w, h) / (4 * wh) : 0;
}

double Microfacets::weight(const Vec3& w, const Vec3& s, const Vec3& h) const {
  const double g = shadowing(w, s, h);
  if (g <= 0) return 0;
  return sampling == FacetSampling::all ? g * dot(w, h) / (w.z * h.z) : g / masking_of(w, h);
}

double Microfacets::integrate(const Vec3& w, const std::function<double(const Vec3& h)>& value,
                              int slopes) const {
  // Midpoint rule in the random numbers of (2.33) to (2.36), with more points where the integrand bends.
  // Slopes: u1 = step(t), a polynomial with zero first three derivatives at both ends, which puts many points
  // on steep facets. Azimuths: a cubic about the facets that `w` sees edge on.
  const auto step = [](double t) { return t * t * t * t * (35 + t * (-84 + t * (70 - 20 * t))); };
  const int azimuths = slopes / 2;
  const double towards = std::atan2(alpha_y * w.y, alpha_x * w.x);
  const bool symmetric = w.y == 0;
  double sum = 0, total = 0;
  for (int k = 0; k < slopes; ++k) {
    const double t = (k + 0.5) / slopes, above = step(1 - t);  // 1 - u1
    const double r = std::sqrt(distribution == FacetDistribution::ggx ? step(t) / above : -std::log(above));
    for (int j = 0; j < azimuths; ++j) {
      const double s = (2 * j + 1.0) / azimuths - 1, phi = pi / 2 * (1 + s * s * s);
      const double share = std::pow(t * (1 - t), 3) * s * s;
      for (const double side : {1, -1}) {
        if (side < 0 && symmetric) continue;
        const Vec3 h = facet(*this, r, towards + side * phi);
        const double wh = dot(w, h);
        if (wh > 0) sum += share * value(h) * wh / (w.z * h.z);
        total += share;
      }
    }
  }
  return sum / total;
}

Microfacets make_microfacets(FacetDistribution distribution, double alpha_x, double alpha_y, Masking masking,
                             FacetSampling sampling) {
  for (const double alpha : {alpha_x, alpha_y}) detail::require_range("roughness", alpha, 0.001, 1);
  if (distribution != FacetDistribution::ggx && sampling == FacetSampling::visible)
    throw std::invalid_argument("visible normals are only sampled for ggx");
  if (distribution != FacetDistribution::beckmann && masking == Masking::smith_rational)
    throw std::invalid_argument("the rational masking is only defined for beckmann");
  return {distribution, alpha_x, alpha_y, masking, sampling};
}

Microfacets make_microfacets(FacetDistribution distribution, double alpha_x, double alpha_y) {
  return make_microfacets(
      distribution, alpha_x, alpha_y, Masking::smith,
      distribution == FacetDistribution::ggx ? FacetSampling::visible : FacetSampling::all);
}

}  // namespace shelfbeam
