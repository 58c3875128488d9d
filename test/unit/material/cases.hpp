#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::test {

struct MaterialCase {
  std::string name;
  Material material;
  Material wrong;  ///< of another roughness or index, which tests must reject
};

inline Vec3 direction_at(double theta_deg, double azimuth = 0.7) {
  const double theta = radians(theta_deg), across = std::sin(theta);
  return {across * std::cos(azimuth), across * std::sin(azimuth), std::cos(theta)};
}

/// From the zenith to grazing angles.
inline const std::vector<double> angles_deg{0, 35, 60, 80, 85, 89};

struct Roughness {
  double x, y;
};

/// Every combination of distribution, masking and sampling.
inline std::vector<Microfacets> all_facets(const std::vector<Roughness>& roughnesses) {
  using enum FacetDistribution;
  std::vector<Microfacets> result;
  for (const auto& [x, y] : roughnesses)
    for (const auto& [distribution, masking, sampling] :
         {std::tuple{ggx, Masking::smith, FacetSampling::visible},
          std::tuple{ggx, Masking::smith, FacetSampling::all},
          std::tuple{ggx, Masking::cook_torrance, FacetSampling::visible},
          std::tuple{beckmann, Masking::smith, FacetSampling::all},
          std::tuple{beckmann, Masking::smith_rational, FacetSampling::all},
          std::tuple{beckmann, Masking::cook_torrance, FacetSampling::all}})
      result.push_back(make_microfacets(distribution, x, y, masking, sampling));
  return result;
}

inline Microfacets scaled(const Microfacets& m, double factor) {
  Microfacets wrong = m;
  wrong.alpha_x *= factor;
  wrong.alpha_y *= factor;
  return wrong;
}

inline std::string name_of(const Microfacets& m) {
  return fmt::format("{} {} {} {:.2f} {:.2f}", m.distribution == FacetDistribution::ggx ? "ggx" : "beckmann",
                     m.masking == Masking::smith            ? "smith"
                     : m.masking == Masking::smith_rational ? "rational"
                                                            : "cook-torrance",
                     m.sampling == FacetSampling::visible ? "visible" : "all", m.alpha_x, m.alpha_y);
}

/// Materials with a lobe that is not a mirror's, for all distributions, maskings, samplings and roughnesses.
inline std::vector<MaterialCase> make_rough_cases() {
  std::vector<MaterialCase> cases{{"lambertian", make_lambertian(0.7), make_plastic(1.5, 0.7)}};
  for (const Microfacets& m : all_facets({{0.05, 0.05}, {0.2, 0.2}, {0.5, 0.5}, {1, 1}, {0.1, 0.4}}))
    cases.push_back({"conductor " + name_of(m), Conductor{1.4, 8, m}, Conductor{1.4, 8, scaled(m, 1.3)}});
  for (const Microfacets& m : all_facets({{0.05, 0.05}, {0.3, 0.3}, {1, 1}, {0.1, 0.4}})) {
    if (m.masking != Masking::smith) continue;
    cases.push_back({"dielectric " + name_of(m), make_dielectric(1.5, m), Dielectric{1.5, scaled(m, 1.3)}});
  }
  for (const double reflectance : {0.1, 1.0})
    cases.push_back({fmt::format("smooth plastic {}", reflectance), make_plastic(1.5, reflectance),
                     make_plastic(1.5, reflectance, make_microfacets(FacetDistribution::ggx, 0.3, 0.3))});
  for (const Microfacets& m : all_facets({{0.05, 0.05}, {0.3, 0.3}, {1, 1}})) {
    if (m.masking == Masking::smith_rational) continue;
    cases.push_back(
        {"plastic " + name_of(m), make_plastic(1.5, 0.5, m), make_plastic(2, 0.5, scaled(m, 0.8))});
  }
  return cases;
}

inline const std::vector<MaterialCase>& rough_cases() {
  static const std::vector<MaterialCase> cases = make_rough_cases();
  return cases;
}

/// Directions above every material, and below materials whose sides differ.
inline std::vector<Vec3> directions_for(const Material& material) {
  std::vector<Vec3> directions;
  for (const double angle : angles_deg) {
    directions.push_back(direction_at(angle));
    if (std::holds_alternative<Dielectric>(material)) directions.push_back(-direction_at(angle, -2));
  }
  return directions;
}

}  // namespace shelfbeam::test
