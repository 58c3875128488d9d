#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/store/plan_store.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/constraints/unit_choice.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "jobs/exit_code.hpp"
#include "jobs/run_file.hpp"

namespace shelfbeam::jobs {

/// A plan with its files.
struct PlanJob {
  std::filesystem::path store, folder;
  PlanRequest plan = {};
  UnitChoice units = {};            ///< besides those of the store
  std::vector<Cause> without = {};  ///< left out of the variation, besides those of the store
  /// Units to be examined instead of planned (given_units); empty: those of the store. Their problem is that
  /// of the file, with `model` and unit failure of this job if these are given.
  std::optional<std::filesystem::path> selection = {};
  std::optional<CommunicationModel> model = {};
  /// Signals to reuse: a signal file, or the folder of a plan (read_given_signals).
  std::optional<std::filesystem::path> signal = {};
  bool is_signal_optional = false;                  ///< signals that cannot be read are simulated
  std::vector<std::filesystem::path> sampled = {};  ///< parts of SampledStates; empty: none
  /// A folder of light operators: a first answer is asked for (run_first_answer).
  std::optional<std::filesystem::path> preview = {};
  unsigned threads = 0;                         ///< 0: all cores
  CheckpointOptions checkpoint = {};            ///< its path is in the folder
  bool allow_outside = false;                   ///< the store may name files outside its folder
  std::optional<std::uint64_t> file_size = {};  ///< StoreLimits::file_size
  bool strict = false;                          ///< warnings count as errors
  bool overwrite = false;                       ///< replace a finished plan in the folder
  bool safe_csv = false;
  bool reports_progress = true;  ///< of a process that runs the job
};

/// Watches a job. All are optional.
struct JobWatch {
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  /// The store was read and its request accepted. Until then, nothing has been written.
  std::function<void()> read = {};
  /// The work begins.
  std::function<void(const Scene&, const SimulationOptions&)> begun = {};
};

/// The end of a job that has not failed.
struct PlanEnd {
  Plan plan;
  SignalTable table;
  std::string answer;    ///< placement.json without its record and its values
  bool is_kept = false;  ///< an interrupted run left the finished plan in the folder unchanged
  /// Folder of the interrupted plan if it could not be continued otherwise.
  std::optional<std::filesystem::path> elsewhere;
  ExitCode code = done;
  bool is_imprecise = false;  ///< the requested relative error was not reached, and no certificate covers it
};

/// A store with the choice of units of a job, and without the causes that it leaves out. Throws InputError.
Store with_choice(Store store, const PlanJob& job);

/// The store of a job with its choice of units. Throws InputError.
Store store_of(const PlanJob& job, const CancelToken* cancel);

/// The signals that a job gives, if any. Throws InputError.
std::optional<StoredSignals> given_signals(const PlanJob& job);

/// Throws InputError if the scene has warnings and `strict` is set.
void expect_no_warnings(const Scene& scene, bool strict);

/// Throws OutputError if the disk has no room for the signal file and the checkpoint of a simulation, and for
/// `others` bytes.
void expect_room_for_matrix(const std::filesystem::path& folder, const Scene& scene,
                            const SimulationOptions& options, std::size_t others = 0);

/// Plans a store and writes the folder of the plan (docs/formats/report.md), all files or none. Cancelled, it
/// writes the results so far; an interrupted run never replaces a finished plan. Throws InputError,
/// OutputError, and Interrupted before there is a result.
PlanEnd run_plan(const PlanJob& job, const JobWatch& watch);

/// The same for a store with_choice that need not be a file. `job.store` names it in errors.
PlanEnd run_plan(const PlanJob& job, Store store, const JobWatch& watch, const RunClock& clock);

}  // namespace shelfbeam::jobs
