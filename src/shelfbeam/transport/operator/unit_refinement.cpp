#include "shelfbeam/transport/operator/unit_refinement.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/run/batch_driver.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t min_evaluated = 2;  // batches
// So that a column of a large shop has enough batches within seconds.
ReuseEffort effort_of(const UnitSurvey& survey) {
  constexpr double most = 1.0 / 3;  // of the unit's light
  ReuseEffort effort = small_batches;
  effort.is_hidden = survey.unseen + survey.unexplored > most;
  return effort;
}

}  // namespace

UnitRefinement::UnitRefinement(const LightOperator& light, const Transceiver& unit, std::uint64_t seed,
                               const RunControl& control)
    : probe_(light.world(), {unit}, true),
      estimator_(probe_, mix_key(seed, hash64("refinement")), effort_of(light.survey(probe_)),
                 SurfaceLinks::between_cells(light.nodes().halves()), control),
      direct_(probe_, SimulationOptions().rules(), all_numbers(probe_.receivers.size()), control),
      signal_(probe_.receivers.size()),
      error_(probe_.receivers.size()) {
  for (std::size_t item = 0; item < estimator_.items(); ++item)
    sums_.emplace_back(estimator_.block(item).rows.size(), false, 0);
  has_value_.resize(signal_.size());
  is_skewed_.resize(signal_.size());
  if (!direct_.is_complete()) throw Interrupted("the refinement was stopped before it began");
}

bool UnitRefinement::is_open(std::size_t item, double target, const std::vector<std::uint8_t>& wanted) const {
  const std::uint32_t batches = sums_[item].batches;
  const auto& rows = estimator_.block(item).rows;
  const auto counts = [&](std::uint32_t i) { return wanted.empty() || wanted[i] != 0; };
  if (batches < min_batches / 2) return std::any_of(rows.begin(), rows.end(), counts);
  // Errors of few batches are uncertain.
  const double limit = batches < min_batches ? target / 4 : target;
  return std::any_of(rows.begin(), rows.end(), [&](std::uint32_t i) {
    return counts(i) &&
           static_cast<double>(error_[i]) > limit * probe_.scene.requirement_of(probe_.scene.labels[i]);
  });
}

std::size_t UnitRefinement::add(std::uint32_t batches, double target, const RunControl& control,
                                const std::vector<std::uint8_t>& wanted) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t item = 0; item < sums_.size(); ++item)
    if (is_open(item, target, wanted)) open.push_back(item);
  // Items with the same number of batches continue together.
  const auto batches_of = [&](std::uint32_t item) { return sums_[item].batches; };
  std::stable_sort(open.begin(), open.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return batches_of(a) < batches_of(b); });
  for (std::size_t done = 0; done < open.size() && !control.cancelled();) {
    const std::uint32_t first = batches_of(open[done]);
    const auto end = std::find_if(open.begin() + static_cast<std::ptrdiff_t>(done), open.end(),
                                  [&](std::uint32_t item) { return batches_of(item) != first; });
    const std::size_t count = static_cast<std::size_t>(end - open.begin()) - done;
    detail::BatchDriver driver(probe_.scene, estimator_, control);
    driver.run(
        std::span(open).subspan(done, count), first, batches,
        [&](std::uint32_t item, std::uint32_t, const BatchValues& values) { sums_[item].add(values); },
        [](std::uint32_t) { return true; });
    done += count;
  }
  for (const std::uint32_t item : open)
    if (sums_[item].batches >= min_evaluated) evaluate(item);
  return open.size();
}

void UnitRefinement::evaluate(std::size_t item) {
  const auto& rows = estimator_.block(item).rows;
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const PowerSums sums = sums_[item].entry(c);
    const std::uint32_t i = rows[c];
    signal_[i] = static_cast<float>(sums.mean() + direct_.straight(i, 0) + direct_.mirrored(i, 0));
    error_[i] = static_cast<float>(sums.standard_error());
    has_value_[i] = 1;
    is_skewed_[i] = sums.is_skewed() ? 1 : 0;
  }
}

std::uint32_t UnitRefinement::fewest_batches() const {
  std::uint32_t fewest = sums_.empty() ? 0 : sums_.front().batches;
  for (const ItemSums& sums : sums_) fewest = std::min(fewest, sums.batches);
  return fewest;
}

std::uint32_t UnitRefinement::most_batches() const {
  std::uint32_t most = 0;
  for (const ItemSums& sums : sums_) most = std::max(most, sums.batches);
  return most;
}

}  // namespace shelfbeam
