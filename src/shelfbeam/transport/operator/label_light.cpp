#include "shelfbeam/transport/operator/label_light.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t quadrants = detail::SurfaceCells::quadrants;
// Cells count as strongly lit above this share of the requirement, where the unit is not hidden from them.
constexpr float strong = 0.4F;

bool is_resolved(const LitShop& shop, std::uint32_t cell) {
  return shop.field.strongest[cell] > strong * shop.requirement &&
         shop.field.sight[cell] != CellSight::hidden;
}

Vec3 unpacked(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

float capped(const LitShop& shop, float irradiance) {
  return std::min(irradiance, shop.spots.cap());
}

}  // namespace

const LabelLight& LabelLightSum::of(const LabelHits& hits, const LitShop& shop) {
  for (std::vector<float>* const sums : {&light_.resolved, &light_.squares, &light_.mean, &light_.spots})
    sums->assign(LabelRows::max_labels, 0);
  sort_blocks(hits, shop);
  hits.sums.add_to(blocks_, block_values_, light_.mean.data());
  add_points(hits, shop);
  if (!hits.lobes.empty()) add_lobes(hits, shop);
  shop.spots.add_light(hits, shop.requirement, light_.spots.data());
  return light_;
}

// Lists the values of blocks, and the points of strongly lit blocks that need a value of their own.
void LabelLightSum::sort_blocks(const LabelHits& hits, const LitShop& shop) {
  blocks_.clear();
  block_values_.clear();
  points_.clear();
  block_ends_.clear();
  point_values_.clear();
  asked_.clear();
  targets_.clear();
  for (std::uint32_t b = 0; b + 1 < hits.blocks.size(); ++b) {
    const LabelHits::Block& block = hits.blocks[b];
    if (shop.field.sight[block.cell] == CellSight::beyond) continue;
    const bool resolved = is_resolved(shop, block.cell);
    float value = 0, straight = 0;
    for (std::uint32_t q = 0; q < quadrants; ++q) {
      value += block.mix[q] * shop.field.indirect[block.cell * quadrants + q];
      straight += block.mix[q] * shop.field.straight[block.cell * quadrants + q];
    }
    if (!resolved)
      value += straight;
    else if (!shop.field.mirrored.empty())
      value += shop.field.mirrored[block.cell];
    if (value > 0) {
      blocks_.push_back(b);
      block_values_.push_back(value);
    }
    if (!resolved) continue;
    const std::uint32_t count = hits.blocks[b + 1].first_point - block.first_point;
    irradiance_.resize(count);
    shop.beam.irradiance(hits.points, block.first_point, count, irradiance_.data());
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!(irradiance_[k] > 0)) continue;
      const std::uint32_t p = block.first_point + k;
      if (shop.field.sight[block.cell] == CellSight::partial) {
        asked_.push_back(static_cast<std::uint32_t>(points_.size()));
        targets_.push_back(hits.points.at(p));
      }
      points_.push_back(p);
      point_values_.push_back(capped(shop, irradiance_[k]));
    }
    block_ends_.push_back(points_.size());
  }
}

void LabelLightSum::add_points(const LabelHits& hits, const LitShop& shop) {
  shares_.resize(targets_.size());
  shop.world.rays.shares(shop.beam.source(), targets_, shares_);
  for (std::size_t a = 0; a < asked_.size(); ++a) point_values_[asked_[a]] *= shares_[a];
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const SurfaceGuide& guide = shop.guides[hits.material[points_[k]]];
    if (point_values_[k] == 0 || !guide.is_detailed()) continue;
    const SurfacePoint point = hits.points.at(points_[k]);
    const double cosine = dot(point.normal, normalized(shop.beam.position() - point.position));
    point_values_[k] *= static_cast<float>(guide.base(cosine) * pi / guide.base_albedo());
  }
  find_deviations();
  hits.weights.add_to(points_, point_values_, deviations_, light_.resolved.data(), light_.squares.data());
}

// Rays from labels are spread evenly, so an error comes from differences between the points in a cell: those
// from their mean, as if they were independent.
void LabelLightSum::find_deviations() {
  deviations_ = point_values_;
  std::size_t begin = 0;
  for (const std::size_t end : block_ends_) {
    const auto count = static_cast<float>(end - begin);
    if (count > 1) {
      const std::span values = std::span(deviations_).subspan(begin, end - begin);
      const float mean = std::accumulate(values.begin(), values.end(), 0.0F) / count,
                  scale = std::sqrt(count / (count - 1));
      for (float& value : values) value = scale * (value - mean);
    }
    begin = end;
  }
}

// Highlights, and surfaces without a base: weak light counts as indirect.
void LabelLightSum::add_lobes(const LabelHits& hits, const LitShop& shop) {
  for (const LabelHits::Lobe& lobe : hits.lobes) {
    const std::uint32_t cell = lobe.node / quadrants;
    if (shop.field.sight[cell] == CellSight::beyond) continue;
    const float scattered = lobe.weight * lobe.own_albedo / static_cast<float>(pi);
    float light = shop.field.indirect[lobe.node];
    if (!is_resolved(shop, cell)) {
      light_.mean[lobe.label] += scattered * (light + shop.field.straight[lobe.node]);
      continue;
    }
    if (!shop.field.mirrored.empty()) light += shop.field.mirrored[cell];
    light_.mean[lobe.label] += scattered * light;
    const SurfacePoint point{unpacked(lobe.position), unpacked(lobe.normal), lobe.triangle};
    const double irradiance = std::min(shop.beam.irradiance(point), static_cast<double>(shop.spots.cap()));
    if (!(irradiance > 0)) continue;
    const Vec3 to_unit = normalized(shop.beam.position() - point.position),
               outgoing = unpacked(lobe.outgoing);
    const Frame frame = Frame::of_surface(normalized(unpacked(lobe.outside)));
    const SurfaceGuide& guide = shop.guides[lobe.material];
    double f = eval(shop.world.scene.materials[lobe.material].material, frame.to_local(outgoing),
                    frame.to_local(to_unit));
    if (guide.has_base())
      f -= guide.exit(dot(point.normal, outgoing)) * guide.base(dot(point.normal, to_unit));
    const double value = static_cast<double>(lobe.weight) * f * irradiance;
    if (!(value > 0)) continue;
    const double share = shop.field.sight[cell] == CellSight::open
                             ? 1
                             : shop.world.rays.transmittance(point, shop.beam.position()).share;
    const auto term = static_cast<float>(value * share);
    light_.resolved[lobe.label] += term;
    light_.squares[lobe.label] += term * term;
  }
}

}  // namespace shelfbeam
