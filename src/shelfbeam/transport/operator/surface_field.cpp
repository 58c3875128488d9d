#include "shelfbeam/transport/operator/surface_field.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/cache/geometric_tail.hpp"

namespace shelfbeam {

namespace {

using detail::SurfaceCells;

// Pairs of rounds: at least, at most, and the share of the last pair in the light from which more follow.
constexpr int min_pairs = 3, max_pairs = 24;
constexpr double much = 0.15;

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
    light_cells(part.cells, world, beam, cap, requirement, field);
    if (world.mirrors.size() > 0) add_images(part.cells, world, beam, requirement, field);
  });
  double omitted = 0;
  for (const Reached& part : parts) {
    field.nodes.insert(field.nodes.end(), part.nodes.begin(), part.nodes.end());
    omitted += part.omitted;
  }
  if (cells_->size() > 0) field.omitted = static_cast<float>(omitted / static_cast<double>(cells_->size()));
  return field;
}

void SurfaceNodes::light_cells(std::span<const std::uint32_t> cells, const World& world, const UnitBeam& beam,
                               float cap, float requirement, SurfaceField& field) const {
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
      const float sum = std::accumulate(e + (of[q] - of[0]), e + (of[q + 1] - of[0]), 0.0F);
      // The whole cell's share counts like one more point.
      field.straight[first_node(cells[c]) + q] =
          sum / static_cast<float>(of[q + 1] - of[q]) * (arrived[q] + one * share) / (open[q] + one);
    }
  }
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

// Jacobi iteration between cells, in which the two halves of the links take turns. Further pairs of rounds
// follow as a geometric series with the ratio of the last two increments, and a last round between quadrants
// with all links.
void SurfaceNodes::bounce(std::span<const float> first_bounce, SurfaceField& field) const {
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t node : field.nodes)
    if (cells.empty() || cells.back() != node / quadrants) cells.push_back(node / quadrants);
  // Straight light, its first bounce, total light, and the part of one or more bounces.
  const std::size_t n = cells_->size();
  std::vector<float> straight(n), first(n), light(n), fresh(n), indirect(n), before(n);
  for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
    mean_of_cells(some, field.straight, straight);
    if (!first_bounce.empty()) mean_of_cells(some, first_bounce, first);
  });
  light = straight;
  std::vector<double> sums(parts_of(cells));
  const auto gather = [&](const SurfaceLinks& half) {
    for_parts(cells, [&](std::size_t part, std::span<const std::uint32_t> some) {
      double total = 0;
      for (const std::uint32_t cell : some) {
        indirect[cell] = first[cell] + half.sum(cell, light);
        fresh[cell] = straight[cell] + indirect[cell];
        total += static_cast<double>(indirect[cell]);
      }
      sums[part] = total;
    });
    light.swap(fresh);
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  };
  std::array<double, 3> totals{};  // of the last three pairs
  for (int pair = 0; pair < max_pairs && (pair < min_pairs || totals[2] - totals[1] > much * totals[2]);
       ++pair) {
    before.swap(indirect);
    double total = 0;
    for (const SurfaceLinks& half : cell_halves_) total = gather(half);
    totals = {totals[1], totals[2], total};
  }
  const float further = detail::geometric_tail(totals);
  std::vector<float> by_node(size());
  for_parts(cells, [&](std::size_t, std::span<const std::uint32_t> some) {
    for (const std::uint32_t cell : some) {
      fill_unknown(cell, field.straight);
      const float bounced = indirect[cell] + further * std::max(0.0F, indirect[cell] - before[cell]);
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
