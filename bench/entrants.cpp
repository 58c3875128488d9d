#include "entrants.hpp"

#include <numeric>
#include <utility>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/transport/uniform/uniform.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/direct.hpp"

#include "support.hpp"

namespace shelfbeam::bench {

namespace {

// Of the selection and of the uniform estimator that samples direct light.
constexpr std::uint64_t fixed_seed = 1;

}  // namespace

Selection::Selection(const ReuseEstimator& reuse, std::size_t max_labels) : items(reuse.items()) {
  std::iota(items.begin(), items.end(), std::size_t{0});
  for (std::uint32_t k = 0; k + 1 < items.size(); ++k) {
    const std::uint32_t rest = static_cast<std::uint32_t>(items.size()) - k;
    std::swap(items[k], items[k + to_index(philox({k, 0, 0, 0}, fixed_seed)[0], rest)]);
  }
  std::size_t kept = 0;
  for (; kept < items.size() && labels.size() < max_labels; ++kept) {
    const auto& rows = reuse.block(items[kept]).rows;
    labels.insert(labels.end(), rows.begin(), rows.end());
  }
  items.resize(kept);
}

Entrant::Entrant(std::string name, const World& world, const Selection& selection)
    : title(std::move(name)),
      sums(selection.labels.size(), world.emitters.size()),
      world_(world),
      selection_(selection),
      width_(world.emitters.size()),
      matrix_(selection.labels.size() * width_),
      known_(matrix_.size()) {}

void Entrant::prepare_known_light(const PathRules& rules) {
  known_seconds = cpu_seconds([&] {
    for (std::size_t p = 0; p < selection_.labels.size(); ++p)
      for (std::size_t j = 0; j < width_; ++j) {
        const std::uint32_t i = selection_.labels[p];
        if (!is_point_to_point(world_, i, j)) continue;
        const DirectSignal signal = direct_between_points(world_, i, j, rules);
        known_[p * width_ + j] = signal.straight + signal.mirrored;
      }
  });
}

void Entrant::run() {
  matrix_ = known_;
  seconds += cpu_seconds([&] { sample(batches_); }) - overhead();
  ++batches_;
  sums.add(matrix_);
}

UniformEntrant::UniformEntrant(const World& world, const Selection& selection, bool samples_direct,
                               std::uint32_t walks)
    : Entrant(samples_direct ? "uniform, direct sampled" : "uniform, direct exact", world, selection),
      rules_{.strategy = Strategy::nee, .samples_direct = samples_direct},
      seed_(samples_direct ? fixed_seed : fixed_seed + 1),
      walks_(walks),
      tally_(width_, 1) {
  if (!samples_direct) prepare_known_light(rules_);
}

void UniformEntrant::sample(std::uint32_t batch) {
  tally_.rays = 0;
  for (std::size_t p = 0; p < selection_.labels.size(); ++p) {
    const std::uint32_t i = selection_.labels[p];
    const std::uint64_t stream = mix_key(seed_, hash64(world_.scene.labels[i].id));
    for (std::uint32_t s = 0; s < walks_; ++s) {
      walk_from_label(world_, i, {stream, batch, s}, rules_, tally_);
      collect(p);
    }
    if (!rules_.samples_direct) sample_direct_light(p, batch);
  }
  rays += tally_.rays;
}

// Moves the contributions of a walk from the tally to the matrix. Most entries are zero, so several are
// tested in one step.
void UniformEntrant::collect(std::size_t position) {
  constexpr std::size_t step = 16;
  const std::size_t first = position * width_;
  const auto move = [&](std::size_t j) {
    const double value = tally_.sum(0, j);
    if (value == 0) return;
    matrix_[first + j] += value / walks_;
    ++sums.contributions[first + j];
    tally_.add(0, j, -value);
  };
  std::size_t j = 0;
  for (; j + step <= width_; j += step) {
    bool is_any = false;
    for (std::size_t k = 0; k < step; ++k) is_any |= tally_.sum(0, j + k) != 0;
    if (!is_any) continue;
    for (std::size_t k = 0; k < step; ++k) move(j + k);
  }
  for (; j < width_; ++j) move(j);
}

// UniformEstimator does not read the tally after every walk, so that time is overhead of the benchmark.
double UniformEntrant::overhead() {
  constexpr std::uint32_t part = 8;
  return part * cpu_seconds([&] {
           for (std::size_t p = 0; p < selection_.labels.size(); ++p)
             for (std::uint32_t s = 0; s < walks_ / part; ++s) collect(p);
         });
}

// Does the same as UniformEstimator for labels or sources with an area.
void UniformEntrant::sample_direct_light(std::size_t position, std::uint32_t batch) {
  const std::uint32_t i = selection_.labels[position];
  const std::uint32_t side = direct_strata(walks_, width_);
  for (std::size_t j = 0; j < width_; ++j) {
    if (is_point_to_point(world_, i, j)) continue;
    const PathKey key{mix_key(mix_key(mix_key(seed_, 0xD12EC7), i), j), batch, 0};
    const DirectSignal signal = sample_direct(world_, i, j, key, side, rules_);
    tally_.rays += signal.rays;
    if (signal.straight + signal.mirrored == 0) continue;
    matrix_[position * width_ + j] += signal.straight + signal.mirrored;
    ++sums.contributions[position * width_ + j];
  }
}

ReuseEntrant::ReuseEntrant(const World& world, const Selection& selection, const ReuseEstimator& reuse,
                           double whole_cache_seconds)
    : Entrant("reuse", world, selection), reuse_(reuse) {
  cache_seconds = whole_cache_seconds * static_cast<double>(selection.labels.size()) /
                  static_cast<double>(world.receivers.size());
  prepare_known_light({.strategy = Strategy::nee, .samples_direct = false});
}

void ReuseEntrant::sample(std::uint32_t batch) {
  std::size_t first = 0;
  values_.rays = 0;
  for (const std::size_t item : selection_.items) {
    values_.clear();
    reuse_.sample(item, batch, nullptr, values_);
    for (const BatchValues::Value& value : values_.values) {
      matrix_[first + value.entry] += value.total;
      ++sums.contributions[first + value.entry];
    }
    first += reuse_.block(item).rows.size() * width_;
  }
  rays += values_.rays;
}

}  // namespace shelfbeam::bench
