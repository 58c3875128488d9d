#include "shelfbeam/transport/operator/surface_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"

namespace shelfbeam {

namespace {

using detail::SurfaceCells;

std::size_t first_node(std::size_t cell) {
  return cell * SurfaceCells::quadrants;
}

constexpr float passes = 0.999F;  // a transmittance from which a point counts as open

// Calls body(part, list) for parts of a list, which do not depend on the number of threads.
constexpr std::size_t size_of_parts = 2048;
std::size_t parts_of(std::span<const std::uint32_t> list) {
  return (list.size() + size_of_parts - 1) / size_of_parts;
}
template <class Body>
void for_parts(std::span<const std::uint32_t> list, const Body& body) {
  for_each_task(parts_of(list), [&](std::size_t part) {
    const std::size_t first = part * size_of_parts;
    body(part, list.subspan(first, std::min(size_of_parts, list.size() - first)));
  });
}

}  // namespace

SurfaceNodes::SurfaceNodes(const World& world, std::uint64_t seed, std::uint32_t gather_rays,
                           const RunControl& control)
    : SurfaceNodes(std::make_shared<const SurfaceCells>(world, seed, detail::CellSearch::everywhere, control),
                   world, seed, gather_rays, control) {}

SurfaceNodes::SurfaceNodes(const std::shared_ptr<const SurfaceCells>& cells, const World& world,
                           std::uint64_t seed, std::uint32_t gather_rays, const RunControl& control)
    : SurfaceNodes(cells, {SurfaceLinks(world, cells, seed, {gather_rays, 0, true}, control),
                           SurfaceLinks(world, cells, seed, {gather_rays, gather_rays, true}, control)}) {}

SurfaceNodes::SurfaceNodes(std::shared_ptr<const SurfaceCells> cells, std::array<SurfaceLinks, 2> halves)
    : cells_(std::move(cells)),
      halves_(std::move(halves)),
      cell_halves_{SurfaceLinks::between_cells({&halves_[0], 1}),
                   SurfaceLinks::between_cells({&halves_[1], 1})} {
  for (std::size_t node = 0; node < cells_->size() * quadrants; ++node) {
    first_point_.push_back(static_cast<std::uint32_t>(points_.size()));
    for (const SurfacePoint& point : cells_->sample_points(node / quadrants, node % quadrants))
      points_.add(point);
  }
  first_point_.push_back(static_cast<std::uint32_t>(points_.size()));
  find_growth();
}

std::vector<std::uint8_t> SurfaceNodes::narrow_cells(const World& world) const {
  std::vector<std::uint8_t> narrow(cells_->size());
  parallel_for_ranges(narrow.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      int near = 0, count = 0;
      for (std::size_t node = first_node(cell); node < first_node(cell) + quadrants; ++node) {
        if (!has_points(node)) continue;
        const SurfacePoint point = points_.at(first_point(node));
        const auto hit = world.rays.intersect(point, point.normal);
        near += hit && hit->distance(point.position, point.normal) < detail::CellGrid::size ? 1 : 0;
        ++count;
      }
      narrow[cell] = 2 * near > count ? 1 : 0;
    }
  });
  return narrow;
}

SurfaceField SurfaceNodes::light(const World& world, const UnitBeam& beam, float cap, float requirement,
                                 double reach) const {
  SurfaceField field;
  field.straight.assign(size(), 0);
  field.strongest.assign(cells_->size(), 0);
  field.sight.assign(cells_->size(), CellSight::beyond);
  if (world.mirrors.size() > 0) field.mirrored.assign(cells_->size(), 0);
  const LaneVector at{static_cast<float>(beam.position().x), static_cast<float>(beam.position().y),
                      static_cast<float>(beam.position().z)};
  // Packets of rays do not depend on the number of threads.
  constexpr std::size_t at_once = 512;
  struct Reached {
    std::vector<std::uint32_t> cells, nodes;
    double omitted = 0;
    Flux flux;
  };
  std::vector<Reached> parts((cells_->size() + at_once - 1) / at_once);
  for_each_task(parts.size(), [&](std::size_t k) {
    Reached& part = parts[k];
    for (std::size_t cell = k * at_once; cell < std::min((k + 1) * at_once, cells_->size()); ++cell) {
      const std::uint32_t p = first_point_[first_node(cell)];
      const LaneVector way{points_.x[p] - at.x, points_.y[p] - at.y, points_.z[p] - at.z};
      if (dot(way, way) <= static_cast<float>(reach * reach))
        part.cells.push_back(static_cast<std::uint32_t>(cell));
      else
        part.omitted += beam.irradiance(points_.at(p));
    }
    for (const std::uint32_t cell : part.cells)
      for (std::size_t node = first_node(cell); node < first_node(cell) + quadrants; ++node)
        if (has_points(node)) part.nodes.push_back(static_cast<std::uint32_t>(node));
    part.flux = light_cells(part.cells, world, beam, cap, requirement, field);
    if (world.mirrors.size() > 0) add_images(part.cells, world, beam, requirement, field);
  });
  double omitted = 0;
  Flux flux;
  for (const Reached& part : parts) {
    field.nodes.insert(field.nodes.end(), part.nodes.begin(), part.nodes.end());
    omitted += part.omitted;
    flux.sum += part.flux.sum;
    flux.variance += part.flux.variance;
  }
  if (flux.sum > 0) field.flux_error = static_cast<float>(std::sqrt(flux.variance) / flux.sum);
  if (cells_->size() > 0) field.omitted = static_cast<float>(omitted / static_cast<double>(cells_->size()));
  return field;
}

SurfaceNodes::Flux SurfaceNodes::light_cells(std::span<const std::uint32_t> cells, const World& world,
                                             const UnitBeam& beam, float cap, float requirement,
                                             SurfaceField& field) const {
  constexpr std::size_t max_points = SurfaceCells::max_points * quadrants;
  constexpr float weak = 0.25F, middling = 1, strong = 3;  // of the requirement
  std::vector<float> irradiance(cells.size() * max_points);
  std::vector<std::uint32_t> asked;
  std::vector<RayEnd> targets;
  std::vector<float> shares;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::uint32_t* const of = first_point_.data() + first_node(cells[c]);
    float* const e = irradiance.data() + c * max_points;
    beam.irradiance(points_, of[0], of[quadrants] - of[0], e);
    float strongest = 0;
    for (std::uint32_t k = 0; k < of[quadrants] - of[0]; ++k) {
      e[k] = std::min(e[k], cap);
      strongest = std::max(strongest, e[k]);
    }
    field.strongest[cells[c]] = strongest;
    field.sight[cells[c]] = CellSight::hidden;
    if (!(strongest > 0)) continue;
    // Weak light: one lit point, or one in two quadrants; or one in each quadrant; or all of them.
    const std::uint32_t max_quadrants = strongest < weak * requirement       ? 1
                                        : strongest < middling * requirement ? 2
                                                                             : quadrants;
    const std::uint32_t max_each = strongest < strong * requirement ? 1 : SurfaceCells::max_points;
    std::uint32_t lit_quadrants = 0;
    for (const std::uint32_t q : {0U, 3U, 1U, 2U}) {  // opposite ones first
      std::uint32_t lit = 0;
      for (std::uint32_t k = of[q]; k < of[q + 1] && lit < max_each; ++k) {
        if (!(e[k - of[0]] > 0)) continue;
        asked.push_back(k);
        targets.push_back(points_.at(k));
        ++lit;
      }
      if (lit > 0 && ++lit_quadrants == max_quadrants) break;
    }
  }
  shares.resize(targets.size());
  world.rays.shares(beam.source(), targets, shares);

  Flux flux;
  std::size_t a = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::uint32_t* const of = first_point_.data() + first_node(cells[c]);
    const float* const e = irradiance.data() + c * max_points;
    std::array<float, quadrants> open{}, arrived{};
    bool any_hidden = false, any_seen = false;
    float count = 0;
    for (; a < asked.size() && asked[a] >= of[0] && asked[a] < of[quadrants]; ++a) {
      std::uint32_t q = 0;
      while (asked[a] >= of[q + 1]) ++q;
      open[q] += e[asked[a] - of[0]];
      arrived[q] += e[asked[a] - of[0]] * shares[a];
      any_seen = any_seen || shares[a] > 0;
      any_hidden = any_hidden || shares[a] < passes;
      ++count;
    }
    if (!any_seen) continue;
    field.sight[cells[c]] = any_hidden ? CellSight::partial : CellSight::open;
    const float whole = std::accumulate(open.begin(), open.end(), 0.0F);
    const float share = std::accumulate(arrived.begin(), arrived.end(), 0.0F) / whole, one = whole / count;
    for (std::uint32_t q = 0; q < quadrants; ++q) {
      if (of[q] == of[q + 1]) continue;
      const std::span<const float> own(e + (of[q] - of[0]), of[q + 1] - of[q]);
      const float mean = std::accumulate(own.begin(), own.end(), 0.0F) / static_cast<float>(own.size());
      // The whole cell's share counts like one more point.
      const float arriving = (arrived[q] + one * share) / (open[q] + one);
      field.straight[first_node(cells[c]) + q] = mean * arriving;
      const double off = own.size() == 2 ? static_cast<double>((own[0] - own[1]) / 2 * arriving) : 0;
      flux.sum += static_cast<double>(mean * arriving);
      flux.variance += off * off;
    }
  }
  return flux;
}

// Adds the light over plane mirrors at one point of each cell.
void SurfaceNodes::add_images(std::span<const std::uint32_t> cells, const World& world, const UnitBeam& beam,
                              float requirement, SurfaceField& field) const {
  constexpr float surely = 0.99F;  // despite rounding
  const float least = 0.02F * requirement;
  BeamPoints middles;
  middles.reserve(cells.size());
  for (const std::uint32_t cell : cells) {
    const std::uint32_t* const of = first_point_.data() + first_node(cell);
    middles.add(points_.at((of[0] + of[quadrants]) / 2));
  }
  std::vector<float> most(cells.size());
  for (std::size_t g = 0; g < world.mirrors.size(); ++g) {
    beam.irradiance_of_image(g, middles, most.data());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (most[c] < surely * least) continue;
      const SurfacePoint point = middles.at(c);
      const auto way = world.mirrors.mirror_path(g, point.position, beam.position());
      if (!way) continue;
      const double cosine = dot(way->from_first, point.normal);
      const double open = cosine > 0 ? beam.irradiance(*way, cosine) : 0;
      if (open < static_cast<double>(least)) continue;
      field.mirrored[cells[c]] +=
          static_cast<float>(open * world.mirrors.share(g, *way, point, beam.position(), world.rays));
    }
  }
  for (const std::uint32_t cell : cells)
    for (std::uint32_t q = 0; q < quadrants; ++q)
      field.straight[first_node(cell) + q] += field.mirrored[cell];
}

// Quadrants without points are as bright as the others of their cell.
void SurfaceNodes::fill_unknown(std::size_t cell, std::vector<float>& by_node) const {
  float sum = 0, known = 0;
  for (std::size_t node = cell * quadrants; node < (cell + 1) * quadrants; ++node) {
    if (!has_points(node)) continue;
    sum += by_node[node];
    ++known;
  }
  if (known == quadrants || known == 0) return;
  for (std::size_t node = cell * quadrants; node < (cell + 1) * quadrants; ++node)
    if (!has_points(node)) by_node[node] = sum / known;
}

void SurfaceNodes::mean_of_cells(std::span<const std::uint32_t> cells, std::span<const float> by_node,
                                 std::vector<float>& mean) const {
  for (const std::uint32_t cell : cells) {
    float sum = 0, known = 0;
    for (std::size_t node = first_node(cell); node < first_node(cell) + quadrants; ++node) {
      if (!has_points(node)) continue;
      sum += by_node[node];
      ++known;
    }
    mean[cell] = known > 0 ? sum / known : 0;
  }
}

// The growth of light in pairs of rounds, by power iteration.
void SurfaceNodes::find_growth() {
  constexpr int pairs = 10;
  const std::size_t n = cells_->size();
  std::vector<float> light(n, 1), bounced(n), next(n);
  growth_.assign(n, 0);
  const auto gather = [&](const SurfaceLinks& half, const std::vector<float>& from, std::vector<float>& to) {
    parallel_for_ranges(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t cell = begin; cell < end; ++cell) to[cell] = half.sum(cell, from);
    });
  };
  for (int pair = 0; pair < pairs; ++pair) {
    gather(cell_halves_[0], light, bounced);
    gather(cell_halves_[1], bounced, next);
    for (std::size_t cell = 0; cell < n; ++cell)
      growth_[cell] = light[cell] > 0 ? next[cell] / light[cell] : 0;
    light.swap(next);
  }
}

// Chebyshev iteration on eigenvalues of both signs (those between surfaces that face each other are
// negative), up to the spectral radius. Its error is at most twice the rate to the power of the rounds in all
// parts of a shop, also where light arrives late.
void SurfaceNodes::choose_rounds(double max_growth) {
  constexpr double max_radius = 0.995, error = 0.002;
  squared_radius_ = std::min(max_radius * max_radius, max_growth);
  const double rate = std::sqrt(squared_radius_) / (1 + std::sqrt(1 - squared_radius_));
  rounds_ = rate > 0 ? static_cast<int>(std::ceil(std::log(error / 2) / std::log(rate))) : 1;
}

// `sum`(round, cell, light): the light that comes from other cells.
template <class Sum>
std::vector<float> SurfaceNodes::iterate(std::span<const std::uint32_t> cells,
                                         const std::vector<float>& source, std::vector<float> light,
                                         const Sum& sum) const {
  std::vector<float> next(light.size());
  double omega = 1;
  for (int round = 0; round < rounds_; ++round) {
    if (round > 0) omega = 4 / (4 - squared_radius_ * (round == 1 ? 2 : omega));
    const auto step = static_cast<float>(omega);
    for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
      for (const std::uint32_t cell : some)
        next[cell] += step * (source[cell] + sum(round, cell, light) - next[cell]);
    });
    light.swap(next);
  }
  return light;
}

std::vector<float> SurfaceNodes::total_light(const std::vector<float>& straight,
                                             std::optional<std::uint64_t> sample) const {
  return iterate(all_numbers<std::uint32_t>(cells_->size()), straight, straight,
                 [&](int, std::uint32_t cell, const std::vector<float>& light) {
                   if (sample) return cell_halves_[mix_key(*sample, cells_->key(cell)) & 1].sum(cell, light);
                   return (cell_halves_[0].sum(cell, light) + cell_halves_[1].sum(cell, light)) / 2;
                 });
}

// The two halves of the links between cells take turns; a last round between quadrants uses all links.
void SurfaceNodes::bounce(std::span<const float> first_bounce, SurfaceField& field) const {
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t node : field.nodes)
    if (cells.empty() || cells.back() != node / quadrants) cells.push_back(node / quadrants);
  std::vector<float> straight(cells_->size()), source(cells_->size());
  for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
    mean_of_cells(some, field.straight, straight);
    if (!first_bounce.empty()) mean_of_cells(some, first_bounce, source);
    for (const std::uint32_t cell : some) source[cell] += straight[cell];
  });
  const std::vector<float> light =
      iterate(cells, source, straight, [&](int round, std::uint32_t cell, const std::vector<float>& before) {
        return cell_halves_[static_cast<std::size_t>(round % 2)].sum(cell, before);
      });
  std::vector<float> by_node(size());
  for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
    for (const std::uint32_t cell : some) {
      fill_unknown(cell, field.straight);
      const float bounced = std::max(0.0F, light[cell] - straight[cell]);
      for (std::size_t node = first_node(cell); node < first_node(cell) + quadrants; ++node)
        by_node[node] = field.straight[node] + bounced;
    }
  });
  field.indirect.assign(size(), 0);
  for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
    for (const std::uint32_t cell : some) {
      for (std::size_t node = first_node(cell); node < first_node(cell) + quadrants; ++node)
        if (has_points(node))
          field.indirect[node] = (first_bounce.empty() ? 0 : first_bounce[node]) +
                                 (halves_[0].sum(node, by_node) + halves_[1].sum(node, by_node)) / 2;
      fill_unknown(cell, field.indirect);
    }
  });
}

std::size_t SurfaceNodes::bytes() const {
  return points_.bytes() + 4 * first_point_.size() + halves_[0].bytes() + halves_[1].bytes() +
         cell_halves_[0].bytes() + cell_halves_[1].bytes() + cells_->bytes();
}

}  // namespace shelfbeam
