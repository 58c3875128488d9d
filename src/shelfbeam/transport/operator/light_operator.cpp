#include "shelfbeam/transport/operator/light_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cache/smallest_requirement.hpp"
#include "shelfbeam/transport/operator/label_light.hpp"
#include "shelfbeam/transport/world/direct.hpp"
#include "shelfbeam/transport/world/label_clusters.hpp"

namespace shelfbeam {

namespace {

std::uint64_t stream_of(std::uint64_t seed) {
  return mix_key(seed, hash64("light operator"));
}

// The standard error of a preview. Its parts come from the quadrature by points; from the mean light of cells
// (the mean itself, the links between cells, the straight light); from spots; from light beyond the reach;
// and a rest. docs/methods/light_operator.md has the comparison that gives the factors.
class PreviewError {
 public:
  PreviewError(const OperatorEffort& effort, const SurfaceField& field)
      : of_squares_(1.6F + 24 / static_cast<float>(effort.label_rays)),
        of_mean_(0.011F * std::sqrt(256 / static_cast<float>(effort.label_rays))),
        of_flux_(1.7F * field.flux_error),
        omitted_(1.8F * field.omitted) {}

  // Of the label c of a cluster. `common`: the cluster's common error; `response`: the label's largest.
  float operator()(const LabelLight& light, std::size_t c, float common, float requirement,
                   double response) const {
    constexpr float of_spots = 0.4F, of_requirement = 0.0026F;
    const float cells = light.mean[c] * light.mean[c] *
                        (of_mean_ * of_mean_ + of_flux_ * of_flux_ + 1.55F * common * common),
                spots = of_spots * light.spots[c], omitted = omitted_ * static_cast<float>(response),
                rest = of_requirement * requirement;
    return std::sqrt(of_squares_ * light.squares[c] + cells + spots * spots + omitted * omitted +
                     rest * rest);
  }

 private:
  float of_squares_, of_mean_, of_flux_, omitted_;
};

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

// By label of a cluster: the sum over cells of a value times the label's weight of the cell.
template <class Value>
std::array<float, LabelRows::max_labels> sums_over_cells(const LabelHits& hits, const Value& value_of) {
  const auto rows = all_numbers<std::uint32_t>(hits.blocks.size() - 1);
  std::vector<float> values(rows.size());
  for (const std::uint32_t b : rows) values[b] = value_of(hits.blocks[b].cell);
  std::array<float, LabelRows::max_labels> sums{};
  hits.sums.add_to(rows, values, sums.data());
  return sums;
}

// The largest growth of the light that labels receive from cells: around the label where light lives longest.
// Cells that see little but each other would need many rounds, but count only for labels that see them.
double max_growth(const SurfaceNodes& nodes, const std::vector<LabelHits>& clusters) {
  std::vector<float> largest(clusters.size());
  parallel_for_ranges(clusters.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const LabelHits& hits = clusters[k];
      const auto weighted = sums_over_cells(hits, [&](std::uint32_t cell) { return nodes.growth()[cell]; });
      const auto weights = sums_over_cells(hits, [](std::uint32_t) { return 1.0F; });
      for (std::size_t c = 0; c < hits.labels.size(); ++c)
        if (weights[c] > 0) largest[k] = std::max(largest[k], weighted[c] / weights[c]);
    }
  });
  return largest.empty() ? 0 : static_cast<double>(*std::max_element(largest.begin(), largest.end()));
}

// The relative error of the light from cells that the links between cells cause at the labels of each
// cluster, all together: they have the same bounces before their own rays. It is the root mean square over
// the labels, for lamps at random places. Ends early when cancelled.
std::vector<float> common_errors(const World& world, const SurfaceNodes& nodes,
                                 const std::vector<LabelHits>& clusters, std::uint64_t seed,
                                 const RunControl& control) {
  constexpr std::uint64_t lamps = 8;
  std::vector<double> squares(clusters.size()), count(clusters.size());
  for (std::uint64_t lamp = 0; lamp < lamps && !control.cancelled(); ++lamp) {
    const std::uint64_t key = mix_key(seed, lamp);
    const std::vector<float> straight = lamp_light(world, nodes, key);
    const std::array light{nodes.total_light(straight, std::nullopt), nodes.total_light(straight, key)};
    parallel_for_ranges(clusters.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const LabelHits& hits = clusters[k];
        const auto bounced = [&](const std::vector<float>& all) {
          return sums_over_cells(hits, [&](std::uint32_t cell) { return all[cell] - straight[cell]; });
        };
        const auto mean = bounced(light[0]), sampled = bounced(light[1]);
        for (std::size_t c = 0; c < hits.labels.size(); ++c) {
          if (!(mean[c] > 0)) continue;
          const double error = static_cast<double>(sampled[c]) / static_cast<double>(mean[c]) - 1;
          squares[k] += error * error;
          ++count[k];
        }
      }
    });
  }
  std::vector<float> errors;
  for (std::size_t k = 0; k < clusters.size(); ++k)
    errors.push_back(count[k] > 0 ? static_cast<float>(std::sqrt(squares[k] / count[k])) : 0);
  // No lamp lights some clusters, as in a small closed room.
  const float largest = errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
  for (std::size_t k = 0; k < clusters.size(); ++k)
    if (count[k] == 0) errors[k] = largest;
  return errors;
}

std::vector<float> direct_signals(const World& probe, std::uint64_t stream) {
  const PathRules rules{.strategy = Strategy::nee, .samples_direct = false};
  constexpr std::uint32_t strata = 3;
  std::vector<float> signals(probe.receivers.size());
  parallel_for_ranges(signals.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const DirectSignal direct = is_point_to_point(probe, i, 0)
                                      ? direct_between_points(probe, i, 0, rules)
                                      : sample_direct(probe, i, 0, {mix_key(stream, i), 0, 0}, strata, rules);
      signals[i] = static_cast<float>(direct.straight + direct.mirrored);
    }
  });
  return signals;
}

// The world with a unit instead of all others.
World probe_of(const World& world, const Transceiver& unit) {
  std::vector<Transceiver> units{unit};
  units[0].id = "unit";  // an id would change the random numbers
  return {world, std::move(units), false};
}

// Doubts about all signals of a unit.
std::uint8_t doubts_of(const UnitSurvey& survey) {
  constexpr double much = 0.1, most = 0.15;  // of the unit's light
  unsigned doubts = 0;
  if (survey.near > much) doubts |= static_cast<unsigned>(Doubt::near_surface);
  if (survey.bent > most) doubts |= static_cast<unsigned>(Doubt::mirrors);
  if (survey.unexplored > much) doubts |= static_cast<unsigned>(Doubt::unexplored);
  return static_cast<std::uint8_t>(doubts);
}

// Doubts about a label.
std::uint8_t doubts_of(const LabelHits& hits, std::size_t c) {
  constexpr float most = 0.5F, much = 0.1F, some = 0.05F;  // of the label's rays
  unsigned doubts = 0;
  if (hits.bent[c] > some) doubts |= static_cast<unsigned>(Doubt::mirrors);
  if (hits.unknown[c] > much) doubts |= static_cast<unsigned>(Doubt::unexplored);
  if (hits.narrow[c] > most) doubts |= static_cast<unsigned>(Doubt::narrow);
  return static_cast<std::uint8_t>(doubts);
}

}  // namespace

std::vector<float> direct_column(const World& world, const Transceiver& unit, std::uint64_t seed) {
  return direct_signals(probe_of(world, unit), stream_of(seed));
}

LightOperator::LightOperator(const World& world, std::uint64_t seed, const OperatorEffort& effort,
                             SurfaceNodes nodes)
    : world_(world),
      seed_(seed),
      stream_(stream_of(seed)),
      effort_(effort),
      requirement_(static_cast<float>(smallest_requirement(world.scene))),
      nodes_(std::move(nodes)) {}

LightOperator::LightOperator(const World& world, std::uint64_t seed, const OperatorEffort& effort,
                             const RunControl& control)
    : LightOperator(world, seed, effort, SurfaceNodes(world, stream_of(seed), effort.gather_rays, control)) {
  std::vector<LabelCluster> clusters =
      cluster_labels(world, all_numbers<LabelId>(world.receivers.size()), LabelRows::max_labels);
  clusters_.resize(clusters.size());
  const RayTargets targets(world.scene);
  const std::vector<std::uint8_t> narrow = nodes_.narrow_cells(world);
  const auto stop_if_cancelled = [&] {
    if (control.cancelled()) throw Interrupted("the light of the shop was not computed completely");
  };
  constexpr std::size_t at_once = 16;
  for (std::size_t begin = 0; begin < clusters.size(); begin += at_once) {
    constexpr double surfaces = 0.3;  // share of the time
    control.report(Task::preparing, surfaces + (1 - surfaces) * static_cast<double>(begin) /
                                                   static_cast<double>(clusters.size()));
    for_each_task(std::min(at_once, clusters.size() - begin), [&](std::size_t k) {
      clusters_[begin + k] = find_label_hits(world, nodes_, narrow, clusters[begin + k], targets,
                                             effort.label_rays, stream_, control);
    });
    stop_if_cancelled();
  }
  finish();
  common_errors_ =
      common_errors(world, nodes_, clusters_, mix_key(stream_, hash64("common errors")), control);
  stop_if_cancelled();
}

void LightOperator::finish() {
  nodes_.choose_rounds(max_growth(nodes_, clusters_));
  seen_.assign(nodes_.cells().size(), 0);
  for (const LabelHits& hits : clusters_) {
    for (const LabelHits::Block& block : std::span(hits.blocks).first(hits.blocks.size() - 1))
      seen_[block.cell] = 1;
    for (const LabelHits::Lobe& lobe : hits.lobes) seen_[lobe.node / detail::SurfaceCells::quadrants] = 1;
  }
}

UnitSurvey LightOperator::survey(const World& probe) const {
  return survey_unit(probe, nodes_, seen_, mix_key(stream_, hash64("survey")));
}

Preview LightOperator::column(const Transceiver& unit) const {
  const World probe = probe_of(world_, unit);
  const std::size_t m = world_.receivers.size();
  Preview preview;
  preview.signal.resize(m);
  preview.error.resize(m);
  preview.doubts.resize(m);
  preview.direct = direct_signals(probe, stream_);
  const std::uint8_t doubts = doubts_of(survey(probe));
  const UnitSpots spots(probe, nodes_, mix_key(stream_, hash64("spots")));
  const UnitBeam beam(probe);
  SurfaceField field = nodes_.light(probe, beam, spots.cap(), requirement_, effort_.reach);
  nodes_.bounce(spots.light(nodes_, requirement_), field);
  const LitShop shop{probe, nodes_.guides(), beam, field, spots, requirement_};
  const PreviewError error(effort_, field);
  parallel_for_ranges(clusters_.size(), [&](std::size_t begin, std::size_t end) {
    LabelLightSum sum;
    for (std::size_t k = begin; k < end; ++k) {
      const LabelHits& hits = clusters_[k];
      const LabelLight& light = sum.of(hits, shop);
      for (std::size_t c = 0; c < hits.labels.size(); ++c) {
        const std::uint32_t i = hits.labels[c];
        const auto requirement = static_cast<float>(world_.scene.requirement_of(world_.scene.labels[i]));
        preview.signal[i] = preview.direct[i] + light.resolved[c] + light.mean[c] + light.spots[c];
        preview.error[i] =
            error(light, c, common_errors_[k], requirement, largest(world_.receivers.responsivity(i)));
        preview.doubts[i] = doubts | doubts_of(hits, c);
      }
    }
  });
  return preview;
}

std::size_t LightOperator::bytes() const {
  std::size_t sum = nodes_.bytes();
  for (const LabelHits& hits : clusters_) sum += hits.bytes();
  return sum;
}

}  // namespace shelfbeam
