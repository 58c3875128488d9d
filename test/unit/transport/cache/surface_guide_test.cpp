#include "shelfbeam/transport/cache/surface_guide.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cache/lane_kernels.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

Material coated(double roughness, double reflectance = 0.5) {
  return make_plastic(1.5, reflectance, make_microfacets(FacetDistribution::ggx, roughness, roughness));
}
Material brushed(double roughness) {
  return make_conductor(1.7, 8.6, make_microfacets(FacetDistribution::ggx, roughness, roughness));
}

Vec3 upward(std::uint32_t k, std::uint32_t stream) {
  const auto u = philox({k, stream, 0, 0}, 4);
  const double z = 0.05 + 0.95 * to_uniform(u[0]), phi = 2 * pi * to_uniform(u[1]), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}
// The first stream points to one side, the others to the opposite side.
Vec3 grazing(std::uint32_t k, std::uint32_t stream) {
  const auto u = philox({k, stream, 1, 0}, 4);
  const double z = 0.001 + 0.03 * to_uniform(u[0]), phi = 0.03 * to_uniform(u[1]) + (stream == 1 ? 0 : pi);
  return Vec3{std::cos(phi), std::sin(phi), 0} * std::sqrt(1 - z * z) + Vec3{0, 0, z};
}
using Directions = Vec3 (*)(std::uint32_t, std::uint32_t);

// A point on the floor under 64 units.
const SurfacePoint point{{3, 4, 0}, {0, 0, 1}};
test::BareScene sky(Directions directions = upward) {
  test::BareScene sky;
  sky.box(sky.material(Lambertian{0.5}), {0, 0, 0}, {10, 10, 10});
  sky.label({1, 1, 1}, {0, 0, 1});
  for (std::uint32_t k = 0; k < 64; ++k) {
    sky.unit(point.position + directions(k, 1) * 3, {0, 0, -1}, IsotropicHemisphere{1});
    sky.scene.transceivers.back().type = TransceiverTypeId{0};
  }
  sky.scene.transceiver_types.resize(1);
  return sky;
}

// The root mean square deviation of the guide's f from the material's, relative to the latter.
double deviation(const Material& guided, const Material& real, Directions directions = upward) {
  const test::BareScene scene = sky(directions);
  const World world(scene.scene);
  const UnitGroups units(world);
  const SurfaceGuide guide(guided);
  double squares = 0, differences = 0;
  for (std::uint32_t k = 0; k < 100; ++k) {
    const Vec3 out = directions(k, 2);
    const LaneScatter scatter = guide.towards(out, {0, 0, 1}, guide.exit(out.z));
    for (std::size_t j = 0; j < scene.scene.transceivers.size(); ++j) {
      const Vec3 in = normalized(scene.scene.transceivers[j].position - point.position);
      const auto [entry, highlight] = LaneKernels::parts(
          units, units.lane_index(j) / lanes, units.lane_index(j) % lanes, LanePoint(point), scatter);
      const double truth = eval(real, out, in);
      squares += truth * truth;
      differences += std::pow(static_cast<double>(scatter.base * entry + highlight) - truth, 2);
    }
  }
  return std::sqrt(differences / squares);
}

// The polynomials of the Fresnel terms and of the coat's transmittance err by 1 %. The controls are a
// roughness and a reflectance that are slightly off.
TEST(SurfaceGuide, KnowsHighlightsAndBases) {
  for (const double roughness : {0.15, 0.3, 0.6}) {
    EXPECT_LT(deviation(coated(roughness), coated(roughness)), 0.02) << roughness;
    EXPECT_LT(deviation(brushed(roughness), brushed(roughness)), 0.02) << roughness;
    EXPECT_GT(deviation(coated(roughness), coated(1.1 * roughness)), 0.02) << roughness;
    EXPECT_GT(deviation(brushed(roughness), brushed(1.1 * roughness)), 0.02) << roughness;
  }
  EXPECT_LT(deviation(coated(0.3, 0), coated(0.3, 0)), 0.02);
  EXPECT_GT(deviation(coated(0.6, 0.55), coated(0.6, 0.5)), 0.02);
  EXPECT_LT(deviation(make_plastic(1.5, 0.5), make_plastic(1.5, 0.5)), 0.05);
  EXPECT_GT(deviation(make_plastic(1.5, 0.55), make_plastic(1.5, 0.5)), 0.05);
}

// A floor that is rougher along x, which is the store's, than across it, and the reverse. The controls
// exchange the two, or use an isotropic roughness.
TEST(SurfaceGuide, KnowsTheDirectionOfBrushing) {
  const auto metal = [](double x, double y) -> Material {
    return make_conductor(1.7, 8.6, make_microfacets(FacetDistribution::ggx, x, y));
  };
  for (const auto& [x, y] : {std::pair{0.1, 0.3}, {0.5, 0.2}, {0.6, 0.1}}) {
    EXPECT_LT(deviation(metal(x, y), metal(x, y)), 0.02) << x << ' ' << y;
    EXPECT_LT(deviation(metal(x, y), metal(x, y), grazing), 0.03) << x << ' ' << y;
    EXPECT_GT(deviation(metal(y, x), metal(x, y)), 0.2) << x << ' ' << y;
    EXPECT_GT(deviation(metal(std::sqrt(x * y), std::sqrt(x * y)), metal(x, y)), 0.2) << x << ' ' << y;
  }
}

// Within the difference of GGX's masking from Beckmann's; the control is the distribution of GGX.
TEST(SurfaceGuide, KnowsBeckmannFacets) {
  const auto metal = [](FacetDistribution of, double x, double y) -> Material {
    return make_conductor(1.7, 8.6, make_microfacets(of, x, y));
  };
  constexpr FacetDistribution beckmann = FacetDistribution::beckmann, ggx = FacetDistribution::ggx;
  for (const auto& [x, y] : {std::pair{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.5}}) {
    EXPECT_LT(deviation(metal(beckmann, x, y), metal(beckmann, x, y)), 0.06) << x << ' ' << y;
    EXPECT_GT(deviation(metal(ggx, x, y), metal(beckmann, x, y)), 0.15) << x << ' ' << y;
  }
}

// The polynomials are negative where almost nothing is reflected; a probability must not be.
TEST(SurfaceGuide, HasNoNegativeHighlights) {
  const test::BareScene scene = sky();
  const World world(scene.scene);
  const UnitGroups units(world);
  const auto facets = make_microfacets(FacetDistribution::ggx, 0.03, 0.03);
  for (const Material& material :
       {Material{make_plastic(1.02, 0.5, facets)}, Material{make_conductor(0.9, 0, facets)}}) {
    const SurfaceGuide guide(material);
    for (std::size_t j = 0; j < scene.scene.transceivers.size(); ++j) {
      const Vec3 in = normalized(scene.scene.transceivers[j].position - point.position);
      const Vec3 out{-in.x, -in.y, in.z};
      const LaneKernels::Parts parts =
          LaneKernels::parts(units, units.lane_index(j) / lanes, units.lane_index(j) % lanes,
                             LanePoint(point), guide.towards(out, {0, 0, 1}, guide.exit(out.z)));
      EXPECT_GE(parts.highlight, 0);
    }
  }
}

// At grazing angles almost everything is highlight, and the half vector is a small difference.
TEST(SurfaceGuide, KnowsGrazingHighlights) {
  for (const double roughness : {0.05, 0.15, 0.3}) {
    EXPECT_LT(deviation(coated(roughness), coated(roughness), grazing), 0.03) << roughness;
    EXPECT_GT(deviation(coated(roughness), coated(1.1 * roughness), grazing), 0.03) << roughness;
  }
}

// Vectors agree with single lanes within the rounding of floats; the control omits the highlight.
TEST(SurfaceGuide, IsTheSameInVectors) {
  const test::BareScene scene = sky();
  const World world(scene.scene);
  const UnitGroups units(world);
  const Material material = coated(0.3);
  const SurfaceGuide guide(material);
  std::vector<std::uint16_t> list;
  for (std::size_t g = 0; g < units.size(); ++g) list.push_back(static_cast<std::uint16_t>(g));
  std::vector<std::uint8_t> share(units.size() * lanes);
  std::vector<std::uint16_t> indirect(share.size());
  for (std::size_t k = 0; k < share.size(); ++k) {
    share[k] = PackedLane::pack_share(static_cast<float>(k % 3) / 2);
    indirect[k] = PackedLane::pack(static_cast<float>(k % 5) / 100);
  }
  double with = 0, without = 0;
  for (std::uint32_t k = 0; k < 100; ++k) {
    const Vec3 out = upward(k, 3);
    const LaneScatter scatter = guide.towards(out, {0, 0, 1}, guide.exit(out.z));
    std::vector<float> sums(share.size());
    LaneKernels::add_radiance(units, list.data(), list.size(), LanePoint(point), scatter, false, 2, 0.1F,
                              share.data(), indirect.data(), sums.data());
    for (std::size_t j = 0; j < scene.scene.transceivers.size(); ++j) {
      const std::size_t place = units.lane_index(j), g = place / lanes, lane = place % lanes;
      LaneValues e;
      units.irradiance(g, LanePoint(point), e);
      const auto [entry, highlight] = LaneKernels::parts(units, g, lane, LanePoint(point), scatter);
      const float arrived = e[lane] * PackedLane::share(share[place]);
      const float rest = 0.1F * PackedLane::value(indirect[place]);
      const auto error = [&](float f) {
        return static_cast<double>(std::abs(2 * (f * arrived + rest) / sums[place] - 1));
      };
      if (sums[place] == 0) continue;
      with = std::max(with, error(scatter.base * entry + highlight));
      without = std::max(without, error(scatter.base * entry));
    }
  }
  EXPECT_LT(with, 1e-4);
  EXPECT_GT(without, 0.1);
}

TEST(SurfaceGuide, GivesTheRadianceOfADirection) {
  const Material paper = Lambertian{0.6}, mirror = Conductor{0.2, 6, {}}, smooth = make_plastic(1.5, 0.5);
  const Material twisted = make_conductor(1.7, 8.6, make_microfacets(FacetDistribution::ggx, 0.1, 0.5));
  const Material old = make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::beckmann, 0.3, 0.3));
  struct Row {
    const Material* material;
    bool has_base, is_detailed, has_highlight, is_approximate;
  };
  const Material rough = coated(0.3), metal = brushed(0.3), glossy = coated(0.02);
  for (const Row& row : {Row{&paper, true, false, false, false}, Row{&mirror, false, false, false, false},
                         Row{&smooth, true, true, false, false}, Row{&rough, true, true, true, false},
                         Row{&metal, false, true, true, false}, Row{&old, true, true, true, false},
                         Row{&twisted, false, true, true, false}, Row{&glossy, true, true, true, true}}) {
    const SurfaceGuide guide(*row.material);
    EXPECT_EQ(guide.has_base(), row.has_base) << type_name(*row.material);
    EXPECT_EQ(guide.is_detailed(), row.is_detailed) << type_name(*row.material);
    EXPECT_EQ(guide.has_highlight(), row.has_highlight) << type_name(*row.material);
    EXPECT_EQ(guide.is_approximate(), row.is_approximate) << type_name(*row.material);
  }
  const SurfaceGuide guide(rough);
  for (const double cosine : {0.1, 0.5, 1.0})
    EXPECT_NEAR(guide.exit(cosine) * guide.base_albedo() + 1 - guide.exit(cosine),
                albedo(rough, {std::sqrt(1 - cosine * cosine), 0, cosine}), 1e-9);
  EXPECT_EQ(SurfaceGuide(mirror).flat(), 0);
}

}  // namespace
}  // namespace shelfbeam
