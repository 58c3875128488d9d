#include "shelfbeam/transport/surface_guide.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/material/fresnel.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// Only these are written as vectors.
bool is_plain(const Microfacets& facets) {
  return facets.distribution == FacetDistribution::ggx && facets.masking == Masking::smith &&
         facets.isotropic();
}

}  // namespace

// cos^2 of equally spaced angles.
const std::array<float, CosineCurve::nodes> CosineCurve::at = [] {
  std::array<float, nodes> at{};
  for (std::size_t k = 0; k < nodes; ++k) {
    const double c = std::cos(pi / 2 * (static_cast<double>(k) + 0.5) / static_cast<double>(nodes));
    at[k] = static_cast<float>(c * c);
  }
  return at;
}();

SurfaceGuide::SurfaceGuide(const Material& material) : plastic_(std::get_if<Plastic>(&material)) {
  const Vec3 from = normalized({1, 0, 1});
  if (!has_only_specular(material))
    flat_ = static_cast<float>(
        std::max(0.0, albedo(material, from) - specular_reflectance(material, from)) / pi);
  if (const auto* lambertian = std::get_if<Lambertian>(&material)) {
    has_base_ = knows_all_ = true;
    base_albedo_ = lambertian->reflectance;
    base_ = lambertian->reflectance / pi;
    return;
  }
  const Microfacets* facets = nullptr;
  const auto* conductor = std::get_if<Conductor>(&material);
  if (plastic_ != nullptr) {
    has_base_ = is_coated_ = true;
    knows_all_ = !plastic_->facets;
    base_albedo_ = plastic_->base_albedo;
    base_ = plastic_->base_scale / pi;
    if (plastic_->facets) facets = &*plastic_->facets;
  } else if (conductor != nullptr && conductor->facets) {
    facets = &*conductor->facets;
  }
  if (facets != nullptr && is_plain(*facets)) {
    is_coated_ = has_lobe_ = knows_all_ = true;
    alpha_ = facets->alpha_x;
  }
  if (!is_coated_) return;
  if (plastic_ != nullptr) {
    entry_ = CosineCurve::through([&](double cosine) { return plastic_->transmission(cosine); });
    fresnel_ = CosineCurve::through([&](double cosine) { return fresnel_dielectric(cosine, plastic_->ior); });
  } else {
    fresnel_ = CosineCurve::through(
        [&](double cosine) { return fresnel_conductor(cosine, conductor->eta, conductor->k); });
  }
}

double SurfaceGuide::lobe_albedo(double cosine) const {
  if (plastic_ == nullptr) return static_cast<double>(flat_) * pi;
  return plastic_->facets ? 1 - plastic_->transmission(cosine) : 0;
}

LaneScatter SurfaceGuide::at(const Vec3& normal, const Vec3& outgoing) const {
  constexpr double least_cosine = 1e-4;
  LaneScatter scatter;
  const double cosine = std::clamp(dot(normal, outgoing), least_cosine, 1.0);
  scatter.ox = static_cast<float>(outgoing.x);
  scatter.oy = static_cast<float>(outgoing.y);
  scatter.oz = static_cast<float>(outgoing.z);
  scatter.on = static_cast<float>(cosine);
  scatter.base = has_base_ ? static_cast<float>(base_ * exit(cosine)) : 0;
  scatter.entry = entry_;
  scatter.fresnel = fresnel_;
  if (has_lobe_) {
    const double a2 = alpha_ * alpha_, t2 = a2 * (1 / (cosine * cosine) - 1);
    scatter.alpha2 = static_cast<float>(a2);
    scatter.lobe = static_cast<float>(2 / (1 + std::sqrt(1 + t2)) / (4 * cosine));
  }
  return scatter;
}

}  // namespace shelfbeam
