#include "shelfbeam/transport/cache/surface_guide.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr double smoothest = 0.03;

// There is no vectorised code for other masking, and smoother facets exceed the precision of floats.
bool is_plain(const Microfacets& facets) {
  return facets.masking != Masking::cook_torrance && std::min(facets.alpha_x, facets.alpha_y) >= smoothest;
}

}  // namespace

SurfaceGuide::SurfaceGuide(const Material& material) : plastic_(std::get_if<Plastic>(&material)) {
  if (has_only_specular(material)) return;
  const Vec3 from = normalized({1, 0, 1});
  flat_ =
      static_cast<float>(std::max(0.0, albedo(material, from) - specular_reflectance(material, from)) / pi);
  if (const auto* lambertian = std::get_if<Lambertian>(&material)) {
    has_base_ = true;
    base_albedo_ = lambertian->reflectance;
    base_ = lambertian->reflectance / pi;
    return;
  }
  const auto* conductor = std::get_if<Conductor>(&material);
  const Microfacets* facets = nullptr;
  if (plastic_ != nullptr && plastic_->facets) facets = &*plastic_->facets;
  if (conductor != nullptr && conductor->facets) facets = &*conductor->facets;
  has_highlight_ = plastic_ == nullptr || facets != nullptr;
  if (facets != nullptr) {  // approximated by plain ones if they are not plain
    const double x = std::max(smoothest, facets->alpha_x), y = std::max(smoothest, facets->alpha_y);
    facets_ = Microfacets{facets->distribution, x, y};
    lane_.is_beckmann = facets->distribution == FacetDistribution::beckmann;
    lane_.alpha2 = static_cast<float>(x * y);
    lane_.narrow = static_cast<float>(x / y);
    lane_.skew = static_cast<float>(y / x - x / y);
    lane_.across2 = static_cast<float>(y * y);
    lane_.more = static_cast<float>(x * x - y * y);
  }
  is_loose_ = has_highlight_ && (facets == nullptr || !is_plain(*facets));
  if (plastic_ != nullptr) {
    has_base_ = is_detailed_ = true;
    base_albedo_ = plastic_->base_albedo;
    base_ = plastic_->base_scale / pi;
    lane_.entry = CosineCurve::through([&](double cosine) { return plastic_->transmission(cosine); });
    lane_.fresnel =
        CosineCurve::through([&](double cosine) { return fresnel_dielectric(cosine, plastic_->ior); });
  } else if (facets_) {
    is_detailed_ = true;
    lane_.fresnel = CosineCurve::through(
        [&](double cosine) { return fresnel_conductor(cosine, conductor->eta, conductor->k); });
  }
}

LaneScatter SurfaceGuide::towards(const Vec3& outgoing, const Vec3& normal, double exit) const {
  constexpr double min_cosine = 1e-4;
  LaneScatter scatter;
  const double c = std::clamp(dot(normal, outgoing), min_cosine, 1.0);
  scatter.ox = static_cast<float>(outgoing.x);
  scatter.oy = static_cast<float>(outgoing.y);
  scatter.oz = static_cast<float>(outgoing.z);
  scatter.on = static_cast<float>(c);
  if (has_base_) scatter.base = static_cast<float>(base_ * exit);
  scatter.material = &lane_;
  if (facets_) {
    Vec3 local{std::sqrt(1 - c * c), 0, c};  // any azimuth, unless facets are anisotropic
    if (!facets_->isotropic()) {
      const Frame frame = Frame::of_surface(normal);
      local = frame.to_local(outgoing);
      local.z = c;
      scatter.tx = static_cast<float>(frame.x.x);
      scatter.ty = static_cast<float>(frame.x.y);
      scatter.tz = static_cast<float>(frame.x.z);
    }
    scatter.highlight = static_cast<float>(facets_->masking_of(local, {0, 0, 1}) / (4 * c));
  }
  return scatter;
}

}  // namespace shelfbeam
