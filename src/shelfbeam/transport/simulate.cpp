#include "shelfbeam/transport/simulate.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <span>
#include <stdexcept>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/uniform_walk.hpp"

namespace shelfbeam {

namespace {

// What one thread needs to sample one batch of one label.
struct Workspace {
  explicit Workspace(std::size_t n) : reflected(n), direct(n) {}
  std::vector<double> reflected, direct;
  std::uint64_t rays = 0;
};

// Running mean and squares (Welford 1962) of a row over its batches, one array a quantity, so that the many
// entries that a batch leaves at zero cost little (Moments would repeat the count for each). Only the task
// that has the label touches its row, batch after batch, so the order of additions never depends on the
// threads.
struct Row {
  explicit Row(std::size_t n) : mean(n), squares(n), direct(n) {}
  std::vector<double> mean;
  std::vector<double> squares;  // sum of squared differences from the mean
  std::vector<double> direct;
  std::uint32_t batches = 0;

  void add(const Workspace& work, double samples) {
    ++batches;
    for (std::size_t j = 0; j < mean.size(); ++j) {
      const double value = (work.reflected[j] + work.direct[j]) / samples;
      const double difference = value - mean[j];
      mean[j] += difference / batches;
      squares[j] += difference * (value - mean[j]);
      direct[j] += (work.direct[j] / samples - direct[j]) / batches;
    }
  }

  double standard_error(std::size_t j) const {
    return std::sqrt(squares[j] / (static_cast<double>(batches) * (batches - 1)));
  }
};

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

SignalMatrix empty_matrix(const Scene& scene, const std::string& store_hash,
                          const SimulationOptions& options) {
  SignalMatrix matrix;
  for (const Label& label : scene.labels) matrix.labels.push_back(describe(scene, label));
  for (const Transceiver& unit : scene.transceivers) matrix.transceivers.push_back(describe(scene, unit));
  const std::size_t entries = matrix.rows() * matrix.columns();
  matrix.mean.resize(entries);
  matrix.standard_error.resize(entries);
  matrix.direct.resize(entries);
  matrix.wavelength_nm = scene.wavelength_nm;
  matrix.provenance = {
      std::string(program_version()), store_hash, options.seed,
      options.direct == DirectLight::sampled ? "uniform, direct sampled" : "uniform, direct exact"};
  return matrix;
}

class Simulation {
 public:
  Simulation(const Scene& scene, const SimulationOptions& options, const RunControl& control)
      : options_(options),
        control_(control),
        rays_(scene.mesh),
        emitters_(scene),
        world_{scene, rays_, emitters_},
        n_(scene.transceivers.size()),
        per_batch_(static_cast<std::uint32_t>(samples_per_batch(options.samples))),
        rows_(scene.labels.size(), Row(n_)),
        workspaces_(Workspace(n_)) {
    for (const Label& label : scene.labels) streams_.push_back(mix_key(options.seed, hash64(label.id)));
  }

  void sample() {
    for (std::uint32_t batch = 0; batch < batch_count && !control_.cancelled(); ++batch)
      for_labels([&](std::size_t i, Workspace& work) { sample_batch(i, batch, work); });
  }

  void write(SignalMatrix& matrix) {
    for_labels([&](std::size_t i, Workspace& work) { write_row(i, work, matrix); });
  }

  std::uint32_t fewest_batches() const {
    return std::min_element(rows_.begin(), rows_.end(),
                            [](const Row& a, const Row& b) { return a.batches < b.batches; })
        ->batches;
  }

  std::uint64_t rays_traced() const {
    std::uint64_t total = 0;
    for (const Workspace& work : workspaces_) total += work.rays;
    return total;
  }

 private:
  // What came before the loop is seen by every body, and what the bodies did is seen after it. oneTBB sees to
  // that, too, but inside its prebuilt library, where the thread sanitizer cannot follow.
  template <class Body>
  void for_labels(Body body) {
    std::atomic<bool> begun{false};
    std::atomic<std::size_t> ended{0};
    begun.store(true, std::memory_order_release);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows_.size()), [&](const auto& range) {
      if (!begun.load(std::memory_order_acquire)) return;
      Workspace& work = workspaces_.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, work);
      ended.fetch_add(range.size(), std::memory_order_acq_rel);
    });
    if (ended.load(std::memory_order_acquire) != rows_.size()) throw std::logic_error("labels were left out");
  }

  void sample_batch(std::size_t i, std::uint32_t batch, Workspace& work) {
    if (control_.cancelled()) return;
    std::fill(work.reflected.begin(), work.reflected.end(), 0);
    std::fill(work.direct.begin(), work.direct.end(), 0);
    const std::span<double> direct =
        options_.direct == DirectLight::sampled ? std::span(work.direct) : std::span<double>();
    for (std::uint32_t s = 0; s < per_batch_; ++s) {
      if (s % 1024 == 0 && control_.cancelled()) return;  // a batch begun does not count
      work.rays +=
          uniform_walk(world_, world_.scene.labels[i], {streams_[i], batch, s}, work.reflected, direct);
    }
    rows_[i].add(work, per_batch_);
    report(++batches_done_);
  }

  void report(std::uint64_t done) {
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const auto total = static_cast<double>(rows_.size() * batch_count);
    control_.report("simulating", static_cast<double>(done) / total);
  }

  void write_row(std::size_t i, Workspace& work, SignalMatrix& matrix) {
    const Row& row = rows_[i];
    const Label& label = world_.scene.labels[i];
    const Responsivity& responsivity = world_.scene.type_of(label).responsivity;
    const bool exact = options_.direct == DirectLight::exact;
    for (std::size_t j = 0; j < n_; ++j) {
      const std::size_t entry = matrix.at(i, j);
      const double direct = exact ? direct_signal(label, responsivity, emitters_, j, rays_) : row.direct[j];
      matrix.mean[entry] = static_cast<float>(exact ? row.mean[j] + direct : row.mean[j]);
      matrix.direct[entry] = static_cast<float>(direct);
      matrix.standard_error[entry] = static_cast<float>(row.standard_error(j));
    }
    if (exact) work.rays += n_;
    matrix.labels[i].batches = row.batches;
    matrix.labels[i].samples = std::uint64_t{row.batches} * per_batch_;
  }

  const SimulationOptions& options_;
  const RunControl& control_;
  RayScene rays_;
  Emitters emitters_;
  WalkScene world_;
  std::size_t n_;
  std::uint32_t per_batch_;
  std::vector<Row> rows_;
  std::vector<std::uint64_t> streams_;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  std::atomic<std::uint64_t> batches_done_{0};
  std::mutex report_mutex_;
};

}  // namespace

std::uint64_t samples_per_batch(std::uint64_t samples) {
  return std::max<std::uint64_t>(1, (samples + batch_count - 1) / batch_count);
}

SimulationResult simulate(const Scene& scene, const std::string& store_hash, const SimulationOptions& options,
                          const RunControl& control) {
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
