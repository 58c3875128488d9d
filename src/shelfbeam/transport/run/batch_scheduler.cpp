#include "shelfbeam/transport/run/batch_scheduler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"

namespace shelfbeam::detail {

namespace {

std::size_t entries(const Estimator::Block& block) {
  return block.rows.size() * block.columns.size();
}

// Whether an item's batches include direct light: if the estimator samples it, or if a label or source has an
// area.
bool has_direct(const World& world, const Estimator& estimator, std::size_t item) {
  const auto& block = estimator.block(item);
  return estimator.samples_direct() ||
         !std::all_of(block.rows.begin(), block.rows.end(),
                      [&](std::uint32_t i) { return world.receivers.is_point(i); }) ||
         !std::all_of(block.columns.begin(), block.columns.end(),
                      [&](std::uint32_t j) { return world.emitters.is_point(j); });
}

}  // namespace

std::size_t BatchScheduler::bytes(const World& world, const Estimator& estimator,
                                  const SimulationOptions& options) {
  std::size_t total = 0;
  for (std::size_t item = 0; item < estimator.items(); ++item)
    total += sizeof(ItemSums) + sizeof(double) * ItemSums::size(entries(estimator.block(item)),
                                                                has_direct(world, estimator, item),
                                                                options.layers());
  return total;
}

BatchScheduler::BatchScheduler(const PreparedScene& prepared, const SimulationOptions& options,
                               const std::string& hash, const RunControl& control)
    : world_(prepared.world()),
      estimator_(prepared.estimator()),
      options_(options),
      control_(control),
      analytic_direct_(prepared.direct()),
      limit_(batches_for(estimator_, options)),
      driver_(world_.scene, estimator_, control, [this] { report(); }),
      survey_(world_, estimator_, sums_, analytic_direct_),
      paused_(estimator_.items()),
      precision_(estimator_.items()) {
  sums_.reserve(estimator_.items());
  for (std::size_t item = 0; item < estimator_.items(); ++item)
    sums_.emplace_back(entries(estimator_.block(item)), has_direct(world_, estimator_, item),
                       options.layers());
  if (!options.checkpoint.path.empty())
    checkpoint_.emplace(options.checkpoint.path, identity(hash),
                        static_cast<std::uint32_t>(estimator_.items()));
}

CheckpointIdentity BatchScheduler::identity(const std::string& hash) const {
  std::string stop = fmt::format("samples {}", options_.samples);
  if (options_.relative_error)
    stop = fmt::format("relative-error {} above {} max-samples {}", options_.relative_error->error,
                       options_.relative_error->above, options_.relative_error->max_samples);
  else if (options_.time_s)
    stop = "time";
  CheckpointIdentity identity{{"program version", std::string(program_version())},
                              {"store hash", hash},
                              {"seed", fmt::format("{}", options_.seed)},
                              {"estimator", estimator_.name()},
                              {"stopping rule", stop},
                              {"samples per batch", fmt::format("{}", estimator_.samples_per_batch())},
                              {"number of bounce layers", fmt::format("{}", options_.bounce_layers())},
                              {"lengths of paths", fmt::format("{} steps of {} m", options_.by_length.count,
                                                               options_.by_length.step)},
                              {"labels", fmt::format("{}", world_.receivers.size())},
                              {"sources", fmt::format("{}", world_.emitters.size())},
                              {"items", fmt::format("{}", estimator_.items())}};
  if (const auto [number, count] = options_.part; count > 1)
    identity.emplace_back("part", fmt::format("{} of {}", number, count));
  return identity;
}

bool BatchScheduler::run() {
  resume();
  started_ = Clock::now();
  std::vector<std::uint32_t> todo;
  for (;;) {
    std::uint32_t round = std::numeric_limits<std::uint32_t>::max();
    todo.clear();
    for (std::uint32_t item = 0; item < sums_.size(); ++item) {
      if (!is_running(item) || sums_[item].batches > round) continue;
      if (sums_[item].batches < round) todo.clear();
      round = sums_[item].batches;
      todo.push_back(item);
    }
    if (todo.empty() || is_done(round)) return true;
    const double begun = seconds();
    if (!control_.cancelled()) sample(todo, round);
    last_batch_s_ = seconds() - begun;
    if (control_.cancelled()) {
      save_checkpoint();
      return false;
    }
    predict_total();
    save_checkpoint_if_due();
  }
}

// Whether the running items, which all have at least `round` batches, need no more.
bool BatchScheduler::is_done(std::uint32_t round) {
  if (round < min_batches || round < max_batches()) return false;
  if (control_.cancelled()) return false;
  if (options_.time_s) return seconds() + last_batch_s_ > *options_.time_s;
  if (!options_.relative_error || !is_stopping_point(round)) return false;
  Precision all;
  for (const Precision& of_item : precision_) all += of_item;
  return all.is_enough() || (round >= judged_batches && all.is_hopeless());
}

// After a run is resumed, items do not overtake the items ahead of them, because all are judged together.
std::uint32_t BatchScheduler::batches_at_once(std::size_t items, std::uint32_t round) const {
  std::uint32_t end = round < min_batches ? min_batches : limit_;
  for (std::size_t item = 0; item < sums_.size(); ++item)
    if (is_running(item) && sums_[item].batches > round) end = std::min(end, sums_[item].batches);
  return std::min(BatchDriver::at_once(items), end - round);
}

// Computes the next batches of the items and adds them in order to the items' sums.
void BatchScheduler::sample(const std::vector<std::uint32_t>& items, std::uint32_t round) {
  const auto add = [&](std::uint32_t item, std::uint32_t batch, const BatchValues& values) {
    if (is_running(item) && sums_[item].batches == batch) sums_[item].add(values);
  };
  // A time limit discards no computed batches.
  driver_.run(items, round, batches_at_once(items.size(), round), add, [&](std::uint32_t batch) {
    judge(items, batch + 1);
    return options_.time_s || !is_done(batch + 1);
  });
}

// At a stopping point, pauses the items that are precise enough after `round` batches or cannot become so.
void BatchScheduler::judge(const std::vector<std::uint32_t>& items, std::uint32_t round) {
  if (!options_.relative_error || !is_stopping_point(round)) return;
  parallel_for_ranges(items.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t item = items[k];
      if (sums_[item].batches != round || paused_[item] != 0) continue;
      precision_[item] = survey_.precision(item, *options_.relative_error);
      paused_[item] =
          precision_[item].is_enough() || (round >= judged_batches && precision_[item].is_decided());
    }
  });
}

std::uint32_t BatchScheduler::fewest_batches() const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (const ItemSums& sums : sums_) fewest = std::min(fewest, sums.batches);
  return fewest;
}

std::uint32_t BatchScheduler::max_batches() const {
  std::uint32_t most = 0;
  for (const ItemSums& sums : sums_) most = std::max(most, sums.batches);
  return most;
}

std::uint64_t BatchScheduler::batches() const {
  std::uint64_t all = 0;
  for (const ItemSums& sums : sums_) all += sums.batches;
  return all;
}

double BatchScheduler::seconds() const {
  return std::chrono::duration<double>(Clock::now() - started_).count();
}

// Errors fall with the square root of the number of batches.
double BatchScheduler::seconds_to_halve() const {
  const auto now = static_cast<double>(driver_.batches()), all = now + static_cast<double>(done_before_);
  return now > 0 ? seconds() / now * 3 * all : 0;
}

void BatchScheduler::resume() {
  if (!checkpoint_ || !options_.checkpoint.resume) return;
  checkpoint_->load([&](std::uint32_t item, const CheckpointState& state) {
    ItemSums& sums = sums_[item];
    if (state.values.size() != sums.values.size() || state.batches > limit_)
      throw InputError(checkpoint_->path().string(), "does not match the simulation",
                       "delete it, or start again without resuming", Setting::resumption);
    std::copy(state.values.begin(), state.values.end(), sums.values.begin());
    sums.batches = state.batches;
  });
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_batches;
  for (std::uint32_t item = 0; item < sums_.size(); ++item) {
    done_before_ += sums_[item].batches;
    by_batches[sums_[item].batches].push_back(item);
  }
  for (const auto& [batches, items] : by_batches) judge(items, batches);
}

void BatchScheduler::save_checkpoint() {
  if (!checkpoint_) return;
  const double begun = seconds();
  checkpoint_->save(
      [&](std::uint32_t item) { return CheckpointState{sums_[item].batches, sums_[item].values}; });
  saved_at_ = seconds();
  save_took_ = saved_at_ - begun;
}

bool BatchScheduler::try_to_save() noexcept {
  try {
    save_checkpoint();
    return checkpoint_.has_value();
  } catch (const std::exception&) {  // the file keeps the previous checkpoint
    return false;
  }
}

// Saving takes at most a twentieth of the run time.
void BatchScheduler::save_checkpoint_if_due() {
  const double interval = options_.checkpoint.interval_s;
  if (interval == 0 || seconds() - saved_at_ > std::max(interval, 20 * save_took_)) save_checkpoint();
}

// Predicts the total number of batches from the current errors, for the progress report only.
void BatchScheduler::predict_total() {
  if (control_.progress == nullptr) return;
  const std::uint32_t most = max_batches();
  const auto all = static_cast<double>(done_before_ + driver_.batches());
  if (most >= next_report_) {
    next_report_ = most < min_batches ? 2 * most : most + most / 16;
    const double share = options_.relative_error ? options_.relative_error->above : 0.3;
    const double error = survey_.errors(share).relative.quantile(0.99);
    const std::scoped_lock lock(report_mutex_);
    error_text_ = fmt::format(", error {:.1f} %", 100 * error);
    if (options_.relative_error)
      predicted_ = std::max(all, all * std::pow(error / options_.relative_error->error, 2));
  }
  if (options_.time_s) predicted_ = all * std::max(1.0, *options_.time_s / seconds());
}

void BatchScheduler::report() {
  if (control_.progress == nullptr) return;
  const std::unique_lock lock(report_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const auto all = static_cast<double>(done_before_ + driver_.batches());
  double total = predicted_;
  if (options_.has_fixed_samples()) total = static_cast<double>(limit_) * static_cast<double>(sums_.size());
  const double fraction = total > 0 ? std::min(1.0, all / total) : -1;
  control_.report(Task::simulating, fraction,
                  fmt::format("{:.2f} million rays/s{}",
                              static_cast<double>(driver_.rays()) / seconds() / 1e6, error_text_));
}

}  // namespace shelfbeam::detail
