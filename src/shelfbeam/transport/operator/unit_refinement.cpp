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

// So that a column of a large shop has enough batches within seconds.
ReuseEffort effort_of(const LightOperator& light, const std::vector<Transceiver>& units) {
  constexpr double most = 1.0 / 3;  // of the unit's light
  ReuseEffort effort = small_batches;
  effort.is_hidden = std::any_of(units.begin(), units.end(), [&](const Transceiver& unit) {
    const UnitSurvey survey = light.survey(World(light.world(), {unit}, true));
    return survey.unseen + survey.unexplored > most;
  });
  return effort;
}

}  // namespace

UnitRefinement::UnitRefinement(const LightOperator& light, const std::vector<Transceiver>& units,
                               std::uint64_t seed, const RunControl& control)
    : probe_(light.world(), units, true),
      estimator_(probe_, mix_key(seed, hash64("refinement")), effort_of(light, units),
                 SurfaceLinks::between_cells(light.nodes().halves()), control),
      direct_(probe_, SimulationOptions().rules(), all_numbers<LabelId>(probe_.receivers.size()), control),
      item_of_(probe_.receivers.size()),
      signal_(probe_.receivers.size() * units.size()),
      error_(signal_.size()),
      is_skewed_(signal_.size()) {
  for (std::uint32_t item = 0; item < estimator_.items(); ++item) {
    const Estimator::Block& block = estimator_.block(item);
    sums_.emplace_back(block.rows.size() * block.columns.size(), false, 0);
    for (const std::uint32_t i : block.rows) item_of_[i] = item;
  }
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
    const auto errors = std::span(error_).subspan(at(i, 0), units());
    return counts(i) && static_cast<double>(*std::max_element(errors.begin(), errors.end())) >
                            limit * probe_.scene.requirement_of(probe_.scene.labels[i]);
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
    if (sums_[item].batches >= 2) evaluate(item);
  return open.size();
}

void UnitRefinement::evaluate(std::size_t item) {
  const auto& [rows, columns] = estimator_.block(item);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const PowerSums sums = sums_[item].entry(r * columns.size() + c);
      const std::uint32_t i = rows[r], j = columns[c];
      signal_[at(i, j)] = static_cast<float>(sums.mean() + direct_.straight(i, j) + direct_.mirrored(i, j));
      error_[at(i, j)] = static_cast<float>(sums.standard_error());
      is_skewed_[at(i, j)] = sums.is_skewed() ? 1 : 0;
    }
}

void UnitRefinement::fill(std::size_t label, std::size_t unit, Preview& preview) const {
  preview.signal[label] = std::max(0.0F, signal(label, unit));  // noise may be below zero
  preview.error[label] = standard_error(label, unit);
  preview.doubts[label] = is_skewed(label, unit) ? static_cast<std::uint8_t>(Doubt::skewed) : 0;
}

void UnitRefinement::fill(std::size_t unit, Preview& preview) const {
  for (std::size_t i = 0; i < item_of_.size(); ++i)
    if (has_value(i)) fill(i, unit, preview);
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
