#include "shelfbeam/material/material_shares.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace shelfbeam {

namespace {

// For materials without closed forms. With 8192 points of an additive recurrence, the error is about 1e-3.
MaterialShares sampled_shares(const Material& material, const Vec3& wo) {
  constexpr int count = 8192;
  constexpr double step1 = 0.7548776662466927,
                   step2 = 0.5698402909980532;  // powers of 1 / 1.3247, x^3 = x + 1
  MaterialShares shares;
  double u1 = 0.5, u2 = 0.5;
  for (int k = 0; k < count; ++k) {
    u1 = std::fmod(u1 + step1, 1);
    u2 = std::fmod(u2 + step2, 1);
    if (const auto drawn = sample(material, wo, (k + 0.5) / count, u1, u2))
      (drawn->direction.z > 0 ? shares.reflected : shares.transmitted) += drawn->weight / count;
  }
  return shares;
}

MaterialShares shares(const Material& material, double cosine) {
  // An azimuth halfway between the axes of an anisotropic surface.
  const double across = std::sqrt((1 - cosine * cosine) / 2);
  const Vec3 wo{across, across, cosine};
  if (const auto* pane = std::get_if<ThinDielectric>(&material)) {
    const PaneShares of_pane = pane_shares(*pane, cosine);
    return {of_pane.reflected, of_pane.transmitted};
  }
  if (is_opaque(material)) return {albedo(material, wo), 0};
  if (!has_only_specular(material)) return sampled_shares(material, wo);
  const double reflected = specular_reflectance(material, wo);
  return {reflected, albedo(material, wo) - reflected};
}

}  // namespace

MaterialShares shares_at_normal(const Material& material) {
  return shares(material, 1);
}

MaterialShares hemispherical_shares(const Material& material) {
  if (std::holds_alternative<Lambertian>(material)) return shares(material, 1);
  // Gauss-Legendre quadrature on [-1, 1], eight points.
  constexpr std::array<std::pair<double, double>, 4> nodes{{{0.1834346424956498, 0.3626837833783620},
                                                            {0.5255324099163290, 0.3137066458778873},
                                                            {0.7966664774136267, 0.2223810344533745},
                                                            {0.9602898564975363, 0.1012285362903763}}};
  MaterialShares mean;
  for (const auto& [node, weight] : nodes)
    for (const double x : {-node, node}) {
      const double cosine = (1 + x) / 2;
      const MaterialShares at = shares(material, cosine);
      mean.reflected += weight * cosine * at.reflected;  // 2 cos dcos, and dcos = dx / 2
      mean.transmitted += weight * cosine * at.transmitted;
    }
  return mean;
}

}  // namespace shelfbeam
