#include "shelfbeam/transport/operator/light_operator.hpp"

#include <algorithm>
#include <cmath>
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

// The standard error of a preview: of the quadrature by points, as of independent points, of the mean light
// of cells, of light from beyond the reach, and a rest. docs/methods/light_operator.md has the comparison
// that gives the factors.
struct PreviewError {
  static constexpr float of_omitted = 1.8F, of_requirement = 0.0033F;

  PreviewError(const OperatorEffort& effort, float o)
      : of_squares(1 + 24 / static_cast<float>(effort.label_rays)),
        of_mean(0.027F * std::sqrt(12 * 256 / static_cast<float>(effort.gather_rays * effort.label_rays))),
        omitted(o) {}

  float of_squares, of_mean, omitted;

  // `response`: the label's largest.
  float operator()(float squares, float mean, float requirement, double response) const {
    const float a = of_mean * mean, b = of_omitted * omitted * static_cast<float>(response),
                c = of_requirement * requirement;
    return std::sqrt(of_squares * squares + a * a + b * b + c * c);
  }
};

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
  constexpr float much = 0.1F, some = 0.05F;  // of the label's rays
  unsigned doubts = 0;
  if (hits.bent[c] > some) doubts |= static_cast<unsigned>(Doubt::mirrors);
  if (hits.unknown[c] > much) doubts |= static_cast<unsigned>(Doubt::unexplored);
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
  constexpr std::size_t at_once = 16;
  for (std::size_t begin = 0; begin < clusters.size(); begin += at_once) {
    constexpr double surfaces = 0.3;  // share of the time
    control.report(Task::preparing, surfaces + (1 - surfaces) * static_cast<double>(begin) /
                                                   static_cast<double>(clusters.size()));
    for_each_task(std::min(at_once, clusters.size() - begin), [&](std::size_t k) {
      clusters_[begin + k] =
          find_label_hits(world, nodes_, clusters[begin + k], targets, effort.label_rays, stream_, control);
    });
    if (control.cancelled()) throw Interrupted("the light of the shop was not computed completely");
  }
  mark_seen();
}

void LightOperator::mark_seen() {
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
  const PreviewError error(effort_, field.omitted);
  parallel_for_ranges(clusters_.size(), [&](std::size_t begin, std::size_t end) {
    LabelLightSum sum;
    for (const LabelHits& hits : std::span(clusters_).subspan(begin, end - begin)) {
      const LabelLight& light = sum.of(hits, shop);
      for (std::size_t c = 0; c < hits.labels.size(); ++c) {
        const std::uint32_t i = hits.labels[c];
        const auto requirement = static_cast<float>(world_.scene.requirement_of(world_.scene.labels[i]));
        preview.signal[i] = preview.direct[i] + light.resolved[c] + light.mean[c] + light.spots[c];
        preview.error[i] =
            error(light.squares[c], light.mean[c], requirement, largest(world_.receivers.responsivity(i)));
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
