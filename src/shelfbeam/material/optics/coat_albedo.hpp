#pragma once

#include <array>
#include <optional>

#include "shelfbeam/material/optics/microfacets.hpp"

namespace shelfbeam::detail {

/// E(cos theta): share of light from one direction that a dielectric coat reflects before it enters. In
/// closed form for a smooth coat; tabulated for an isotropic rough one, with an error below 2e-4 (4e-4
/// where it is smoother than 0.05).
class CoatAlbedo {
 public:
  CoatAlbedo(double ior, const std::optional<Microfacets>& facets);

  double at(double cos_theta) const;
  /// Cosine-weighted mean, 2 integral of E mu dmu: exactly that of `at`.
  double average() const { return average_; }

 private:
  static constexpr int intervals = 48;

  // Nodes are equal in x = asinh(cos(theta) / alpha): E changes at the scale of alpha at grazing angles, and
  // more and more slowly above.
  double cosine(double x) const;

  double ior_;
  bool smooth_;
  double alpha_, step_;
  std::array<double, intervals + 1> table_{};
  double average_ = 0;
};

}  // namespace shelfbeam::detail
