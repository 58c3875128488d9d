#include "shelfbeam/transport/simulate.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/batch_row.hpp"
#include "shelfbeam/transport/direct.hpp"
#include "shelfbeam/transport/label_walk.hpp"
#include "shelfbeam/transport/particle.hpp"

namespace shelfbeam {

namespace {

LabelRow describe(const Scene& scene, const Label& label) {
  const LabelType& type = scene.type_of(label);
  LabelRow row;
  row.id = label.id;
  row.type = type.name;
  row.position = label.position;
  row.normal = label.normal;
  row.requirement = type.requirement();
  row.link_cost = type.link_cost;
  row.signal_cost = type.signal_cost;
  return row;
}

TransceiverColumn describe(const Scene& scene, const Transceiver& unit) {
  const TransceiverType& type = scene.type_of(unit);
  return {unit.id, type.name, unit.position, unit.axis, type.cost, unit.installed};
}

std::string estimator_name(const SimulationOptions& options) {
  std::string name = "uniform ";
  switch (options.strategy) {
    case Strategy::walk:
      name += "walk";
      break;
    case Strategy::nee:
      name += "nee";
      break;
    case Strategy::mis:
      name += options.heuristic == Heuristic::balance ? "mis (balance)" : "mis (power)";
      break;
    case Strategy::particle:
      name = "particle";
      break;
  }
  name += options.direct == DirectLight::sampled ? ", direct sampled" : ", direct exact";
  if (options.max_bounces != PathRules::no_limit)
    name += fmt::format(", {} bounces at most", options.max_bounces);
  return name;
}

SignalMatrix empty_matrix(const Scene& scene, const std::string& store_hash,
                          const SimulationOptions& options) {
  SignalMatrix matrix;
  for (const Label& label : scene.labels) matrix.labels.push_back(describe(scene, label));
  for (const Transceiver& unit : scene.transceivers) matrix.transceivers.push_back(describe(scene, unit));
  for (const EmittingSurface& surface : scene.emitting_surfaces) {
    matrix.transceivers.emplace_back();
    matrix.transceivers.back().id = surface.id;
  }
  const std::size_t entries = matrix.rows() * matrix.columns();
  matrix.mean.resize(entries);
  matrix.standard_error.resize(entries);
  matrix.direct.resize(entries);
  if (options.by_bounce)
    matrix.by_bounce.resize(options.max_bounces + 1,
                            {std::vector<float>(entries), std::vector<float>(entries)});
  matrix.wavelength_nm = scene.wavelength_nm;
  matrix.provenance = {std::string(program_version()), store_hash, options.seed, estimator_name(options)};
  return matrix;
}

void expect_possible(const Scene& scene, const SimulationOptions& options) {
  if (options.by_bounce && options.max_bounces == PathRules::no_limit)
    throw InputError("--by-bounce", "needs to know the largest number of bounces", "add --max-bounces");
  if (options.strategy != Strategy::walk) return;
  for (const Transceiver& unit : scene.transceivers)
    if (scene.type_of(unit).radius == 0)
      throw InputError("--strategy walk",
                       fmt::format("never meets transceiver '{}': its type '{}' is a point", unit.id,
                                   scene.type_of(unit).name),
                       "give the type a radius, or use another strategy");
}

// Levels of the sums over paths: direct and reflected, or one for each number of bounces.
std::size_t levels_of(const SimulationOptions& options) {
  return options.by_bounce ? std::size_t{options.max_bounces} + 1 : 2;
}

// The work is dealt out by items: labels, or for particles light sources. An item has an entry of the matrix
// for each of the others.
class Simulation {
 public:
  Simulation(const Scene& scene, const SimulationOptions& options, const RunControl& control)
      : options_(options),
        rules_{options.strategy, options.heuristic, options.max_bounces,
               options.direct == DirectLight::sampled},
        control_(control),
        world_(scene),
        by_source_(options.strategy == Strategy::particle),
        width_(by_source_ ? world_.receivers.size() : world_.emitters.size()),
        per_batch_(static_cast<std::uint32_t>(samples_per_batch(options.samples))),
        rows_(by_source_ ? world_.emitters.size() : world_.receivers.size(),
              BatchRow(width_, options.by_bounce ? levels_of(options) : 0)),
        tallies_(Tally(width_, levels_of(options))) {
    for (const Label& label : scene.labels) label_keys_.push_back(hash64(label.id));
    for (const Transceiver& unit : scene.transceivers) source_keys_.push_back(hash64(unit.id));
    for (const EmittingSurface& surface : scene.emitting_surfaces) source_keys_.push_back(hash64(surface.id));
  }

  void sample() {
    for (std::uint32_t batch = 0; batch < batch_count && !control_.cancelled(); ++batch)
      for_items([&](std::size_t item, Tally& tally) { sample_batch(item, batch, tally); });
  }

  void write(SignalMatrix& matrix) {
    for_items([&](std::size_t item, Tally& tally) { write_item(item, tally, matrix); });
    const std::uint32_t fewest = fewest_batches();
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
      matrix.labels[i].batches = by_source_ ? fewest : rows_[i].batches;
      matrix.labels[i].samples = std::uint64_t{matrix.labels[i].batches} * per_batch_;
    }
  }

  std::uint32_t fewest_batches() const {
    return std::min_element(rows_.begin(), rows_.end(),
                            [](const BatchRow& a, const BatchRow& b) { return a.batches < b.batches; })
        ->batches;
  }

  std::uint64_t rays_traced() const {
    std::uint64_t total = 0;
    for (const Tally& tally : tallies_) total += tally.rays;
    return total;
  }

 private:
  // What came before the loop is seen by every body, and what the bodies did is seen after it. oneTBB sees to
  // that, too, but inside its prebuilt library, where the thread sanitizer cannot follow.
  template <class Body>
  void for_items(Body body) {
    std::atomic<bool> begun{false};
    std::atomic<std::size_t> ended{0};
    begun.store(true, std::memory_order_release);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows_.size()), [&](const auto& range) {
      if (!begun.load(std::memory_order_acquire)) return;
      Tally& tally = tallies_.local();
      for (std::size_t item = range.begin(); item != range.end(); ++item) body(item, tally);
      ended.fetch_add(range.size(), std::memory_order_acq_rel);
    });
    if (ended.load(std::memory_order_acquire) != rows_.size()) throw std::logic_error("items were left out");
  }

  std::size_t label_of(std::size_t item, std::size_t k) const { return by_source_ ? k : item; }
  std::size_t source_of(std::size_t item, std::size_t k) const { return by_source_ ? item : k; }

  void sample_batch(std::size_t item, std::uint32_t batch, Tally& tally) {
    if (control_.cancelled()) return;
    tally.clear();
    const std::uint64_t stream = mix_key(options_.seed, by_source_ ? source_keys_[item] : label_keys_[item]);
    for (std::uint32_t s = 0; s < per_batch_; ++s) {
      if (s % 1024 == 0 && control_.cancelled()) return;  // a batch begun does not count
      const PathKey key{stream, batch, s};
      if (by_source_)
        follow_particle(world_, item, key, rules_, tally);
      else
        walk_from_label(world_, item, key, rules_, tally);
    }
    if (!rules_.samples_direct) sample_direct_light(item, batch, tally);
    rows_[item].add(tally, per_batch_);
    report(++batches_done_);
  }

  // As many direct samples as connections would have been made, in whole squares of strata.
  void sample_direct_light(std::size_t item, std::uint32_t batch, Tally& tally) {
    const double each = static_cast<double>(per_batch_) / static_cast<double>(width_);
    const auto side = static_cast<std::uint32_t>(std::clamp(std::ceil(std::sqrt(each)), 2.0, 64.0));
    for (std::size_t k = 0; k < width_; ++k) {
      const std::size_t i = label_of(item, k), j = source_of(item, k);
      if (is_point_to_point(world_, i, j)) continue;
      const PathKey key{mix_key(mix_key(options_.seed, label_keys_[i]), source_keys_[j]), batch, 0};
      const DirectSignal signal = sample_direct(world_, i, j, key, side, rules_);
      tally.rays += signal.rays;
      tally.add(0, k, signal.straight * per_batch_);
      tally.add(1, k, signal.mirrored * per_batch_);
    }
  }

  void report(std::uint64_t done) {
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const auto total = static_cast<double>(rows_.size() * batch_count);
    control_.report("simulating", static_cast<double>(done) / total);
  }

  void write_item(std::size_t item, Tally& tally, SignalMatrix& matrix) {
    const BatchRow& row = rows_[item];
    for (std::size_t k = 0; k < width_; ++k) {
      const std::size_t i = label_of(item, k), j = source_of(item, k), entry = matrix.at(i, j);
      DirectSignal exact;
      if (!rules_.samples_direct && is_point_to_point(world_, i, j))
        exact = direct_between_points(world_, i, j, rules_);
      tally.rays += exact.rays;
      matrix.mean[entry] = static_cast<float>(row.total.mean(k) + exact.straight + exact.mirrored);
      matrix.direct[entry] = static_cast<float>(row.direct[k] + exact.straight);
      matrix.standard_error[entry] = static_cast<float>(row.total.standard_error(k, row.batches));
      for (std::size_t level = 0; level < row.layers.size(); ++level) {
        const double known = level == 0 ? exact.straight : level == 1 ? exact.mirrored : 0;
        matrix.by_bounce[level].mean[entry] = static_cast<float>(row.layers[level].mean(k) + known);
        matrix.by_bounce[level].standard_error[entry] =
            static_cast<float>(row.layers[level].standard_error(k, row.batches));
      }
    }
  }

  const SimulationOptions& options_;
  PathRules rules_;
  const RunControl& control_;
  World world_;
  bool by_source_;
  std::size_t width_;
  std::uint32_t per_batch_;
  std::vector<BatchRow> rows_;
  std::vector<std::uint64_t> label_keys_, source_keys_;
  tbb::enumerable_thread_specific<Tally> tallies_;
  std::atomic<std::uint64_t> batches_done_{0};
  std::mutex report_mutex_;
};

}  // namespace

std::uint64_t samples_per_batch(std::uint64_t samples) {
  return std::max<std::uint64_t>(1, (samples + batch_count - 1) / batch_count);
}

SimulationResult simulate(const Scene& scene, const std::string& store_hash, const SimulationOptions& options,
                          const RunControl& control) {
  expect_possible(scene, options);
  const auto start = std::chrono::steady_clock::now();
  const int threads = control.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(control.threads);
  tbb::task_arena arena(threads);
  // Where more threads are asked for than there are cores, they are made all the same.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(arena.max_concurrency()));
  SimulationResult result;
  arena.execute([&] {
    Simulation simulation(scene, options, control);
    simulation.sample();
    if (simulation.fewest_batches() < 2)
      throw Interrupted("the simulation was stopped before it had two batches of samples");
    result.complete = simulation.fewest_batches() == batch_count;
    result.matrix = empty_matrix(scene, store_hash, options);
    simulation.write(result.matrix);
    result.rays = simulation.rays_traced();
  });
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace shelfbeam
