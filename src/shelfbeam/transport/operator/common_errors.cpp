#include "shelfbeam/transport/operator/common_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

namespace {

// The straight light on all cells of a lamp that shines equally in all directions, from a random place before
// a surface.
std::vector<float> lamp_light(const World& world, const SurfaceNodes& nodes, std::uint64_t key) {
  const std::size_t cells = nodes.cells().size();
  if (cells == 0) return {};
  const auto point_of = [&](std::size_t cell) {
    return nodes.points().at(nodes.first_point(cell * detail::SurfaceCells::quadrants));
  };
  RandomStream random(key, 0, 0, 0x1A3B);
  const SurfacePoint behind = point_of(to_index(random.bits(), static_cast<std::uint32_t>(cells)));
  const auto ahead = world.rays.intersect(behind, behind.normal);
  const double space = ahead ? ahead->distance(behind.position, behind.normal) : 1;
  const Vec3 at = behind.position + (0.1 + 0.8 * random.uniform()) * space * behind.normal;
  std::vector<float> light(cells);
  parallel_for_ranges(cells, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const SurfacePoint point = point_of(cell);
      const Vec3 way = at - point.position;
      const double squared = length_squared(way), cosine = dot(point.normal, way) / std::sqrt(squared);
      if (cosine > 0)
        light[cell] =
            static_cast<float>(cosine / std::max(1.0, squared) * world.rays.transmittance(point, at).share);
    }
  });
  return light;
}

}  // namespace

std::vector<float> common_errors(const World& world, const SurfaceNodes& nodes,
                                 const std::vector<LabelHits>& clusters, std::uint64_t seed) {
  constexpr std::uint64_t lamps = 8;
  std::vector<double> squares(clusters.size()), count(clusters.size());
  for (std::uint64_t lamp = 0; lamp < lamps; ++lamp) {
    const std::uint64_t key = mix_key(seed, lamp);
    const std::vector<float> straight = lamp_light(world, nodes, key);
    const std::array light{nodes.total_light(straight, std::nullopt), nodes.total_light(straight, key)};
    parallel_for_ranges(clusters.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const LabelHits& hits = clusters[k];
        const auto rows = all_numbers<std::uint32_t>(hits.blocks.size() - 1);
        std::vector<float> values(rows.size());
        std::array<std::array<float, LabelRows::max_labels>, 2> sums{};
        for (std::size_t which = 0; which < 2; ++which) {
          for (const std::uint32_t b : rows)
            values[b] = light[which][hits.blocks[b].cell] - straight[hits.blocks[b].cell];
          hits.sums.add_to(rows, values, sums[which].data());
        }
        for (std::size_t c = 0; c < hits.labels.size(); ++c) {
          if (!(sums[0][c] > 0)) continue;
          const double error = static_cast<double>(sums[1][c]) / static_cast<double>(sums[0][c]) - 1;
          squares[k] += error * error;
          ++count[k];
        }
      }
    });
  }
  std::vector<float> errors;
  for (std::size_t k = 0; k < clusters.size(); ++k)
    errors.push_back(count[k] > 0 ? static_cast<float>(std::sqrt(squares[k] / count[k])) : 0);
  return errors;
}

}  // namespace shelfbeam
