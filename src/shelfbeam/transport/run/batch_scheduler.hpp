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
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Runs an estimator batch by batch. In each round, the items with the fewest batches compute their next
/// batch in parallel, or several batches if items are few. After the round, the batches are added and judged
/// in order. With RelativeError, an item pauses once its own entries are precise enough. This depends on the
/// item's own sums alone, so a run can resume from items with different numbers of batches and ends with the
/// same sums.
class BatchScheduler {
 public:
  /// Memory for the sums of all items, in bytes.
  static std::size_t bytes(const World& world, const Estimator& estimator, const SimulationOptions& options);

  /// The prepared scene must outlive the object.
  BatchScheduler(const PreparedScene& prepared, const SimulationOptions& options, const std::string& hash,
                 const RunControl& control);

  /// Returns true at the end of the run, and false if it was cancelled, after saving a checkpoint.
  bool run();

  const std::vector<ItemSums>& sums() const { return sums_; }
  std::uint32_t fewest_batches() const;
  std::uint64_t batches() const;
  std::uint64_t resumed_batches() const { return done_before_; }
  /// Saves a checkpoint; false if there is none, or on an error.
  bool try_to_save() noexcept;
  bool has_checkpoint() const { return checkpoint_ && checkpoint_->has_saved(); }
  std::uint64_t rays() const { return driver_.rays() + analytic_direct_.rays(); }
  const ShadowRays& shadow_rays() const { return driver_.shadow_rays(); }
  /// Predicted time to halve the standard errors.
  double seconds_to_halve() const;

  const ErrorSurvey& survey() const { return survey_; }

 private:
  using Clock = std::chrono::steady_clock;

  CheckpointIdentity identity(const std::string& hash) const;
  void resume();
  void save_checkpoint();
  void save_checkpoint_if_due();
  bool is_running(std::size_t item) const { return !paused_[item] && sums_[item].batches < limit_; }
  std::uint32_t max_batches() const;
  bool is_done(std::uint32_t round);
  std::uint32_t batches_at_once(std::size_t items, std::uint32_t round) const;
  void sample(const std::vector<std::uint32_t>& items, std::uint32_t round);
  void judge(const std::vector<std::uint32_t>& items, std::uint32_t round);
  void predict_total();
  void report();
  double seconds() const;

  const World& world_;
  const Estimator& estimator_;
  const SimulationOptions& options_;
  const RunControl& control_;
  const AnalyticDirect& analytic_direct_;
  std::uint32_t limit_;  ///< max batches per item
  BatchDriver driver_;
  std::vector<ItemSums> sums_;
  ErrorSurvey survey_;
  std::vector<char> paused_;
  std::vector<Precision> precision_;  ///< of each item, when it was last judged
  Clock::time_point started_ = Clock::now();
  std::uint64_t done_before_ = 0;  ///< batches of all items in the checkpoint

  std::optional<CheckpointFile> checkpoint_;
  double saved_at_ = 0, save_took_ = 0;  ///< s

  double last_batch_s_ = 0;
  std::uint32_t next_report_ = 2;     ///< number of batches at which the progress report updates the errors
  std::atomic<double> predicted_{0};  ///< total batches of all items
  std::string error_text_;
  std::mutex report_mutex_;
};

}  // namespace shelfbeam::detail
