#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/transport/run/batch_driver.hpp"
#include "shelfbeam/transport/run/error_survey.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/tally/known_light.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Runs an estimator batch by batch: the items that are furthest behind get their next batch, or several
/// where items are few, in parallel; then all wait for each other, the batches are added and judged in their
/// order, and what has been reached decides who goes on. With a relative error asked for, an item whose own
/// entries have reached it pauses. That depends on the item's own sums alone, so a run can be taken up again
/// from items that are not equally far, and ends with the same sums.
class Engine {
 public:
  /// Bytes for the sums of all items.
  static std::size_t bytes(const World& world, const Estimator& estimator, const SimulationOptions& options);

  Engine(const World& world, const Estimator& estimator, const SimulationOptions& options,
         const std::string& hash, const RunControl& control);

  /// True when it came to its end, false when it was cancelled on the way. Either way the checkpoint has what
  /// there is.
  bool run();

  const std::vector<ItemSums>& sums() const { return sums_; }
  const KnownLight& known() const { return known_; }
  std::uint32_t fewest_batches() const;
  std::uint64_t batches() const;
  std::uint64_t resumed_batches() const { return done_before_; }
  /// Saves what there is, if that can be done.
  void try_to_save() noexcept;
  bool has_checkpoint() const { return checkpoint_ && checkpoint_->has_saved(); }
  std::uint64_t rays() const { return driver_.rays() + known_.rays(); }
  const ShadowRays& shadow_rays() const { return driver_.shadow_rays(); }
  /// Predicted until the errors are half as large.
  double seconds_to_halve() const;

  const ErrorSurvey& survey() const { return survey_; }

 private:
  using Clock = std::chrono::steady_clock;

  CheckpointIdentity identity(const std::string& hash) const;
  void resume();
  void save_checkpoint();
  void save_checkpoint_if_due();
  bool is_running(std::size_t item) const { return !paused_[item] && sums_[item].batches < limit_; }
  std::uint32_t most_batches() const;
  bool is_done(std::uint32_t round);
  std::uint32_t batches_at_once(std::size_t items, std::uint32_t round) const;
  void sample(const std::vector<std::uint32_t>& items, std::uint32_t round);
  void judge(const std::vector<std::uint32_t>& items, std::uint32_t round);
  void foresee();
  void report();
  double seconds() const;

  const World& world_;
  const Estimator& estimator_;
  const SimulationOptions& options_;
  const RunControl& control_;
  KnownLight known_;
  std::uint32_t limit_;  ///< batches an item
  BatchDriver driver_;
  std::vector<ItemSums> sums_;
  ErrorSurvey survey_;
  std::vector<char> paused_;
  std::vector<Precision> precision_;  ///< of each item, where it was last looked at
  Clock::time_point started_ = Clock::now();
  std::uint64_t done_before_ = 0;  ///< item batches of the checkpoint

  std::optional<CheckpointFile> checkpoint_;
  double saved_at_ = 0, save_took_ = 0;  ///< s

  double last_batch_s_ = 0;
  std::uint32_t next_look_ = 2;       ///< batches after which the errors are looked at for those who watch
  std::atomic<double> predicted_{0};  ///< item batches in all
  std::string error_text_;
  std::mutex report_mutex_;
};

}  // namespace shelfbeam::detail
