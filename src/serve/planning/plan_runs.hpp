#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "jobs/child.hpp"
#include "serve/planning/plan_run.hpp"
#include "serve/planning/run_process.hpp"

namespace shelfbeam::serve {

/// The plans that pages have asked for, which are made one after the other, each in a process of its own and
/// whether or not a page is open; and those that other programs have written to the folder of the project.
/// The list is kept in `.shelfbeam/plans.json`. A run that the end of the program interrupts continues when
/// the next one opens the project, unless the shop has changed since.
class PlanRuns {
 public:
  /// `folder`: of the project. `program`: shelfbeam.
  explicit PlanRuns(std::filesystem::path folder, std::string program = jobs::own_program);
  /// Interrupts the plan that runs, so that it keeps its samples.
  ~PlanRuns();

  /// Adds a run; it returns its number. `plan`: the request (docs/formats/job.md), whose files are names in
  /// the folder. `shop`: shop_hash. Throws InputError for a request that is none.
  std::uint64_t add(Json plan, std::string shop);
  /// Ends a run with its results so far. Throws InputError if it has ended.
  void cancel(std::uint64_t id);
  /// Removes a run that has left no plan from the list. Throws InputError for another one.
  void forget(std::uint64_t id);
  /// Its units were selected in the store.
  void note_entered(std::uint64_t id);
  /// Its report is written again.
  void note_renewed(std::uint64_t id) { renewed_.insert(id); }

  /// To be called often. `shop`: that of the store file now. Returns the numbers of the runs that have
  /// changed, or are no longer in the list.
  std::vector<std::uint64_t> poll(const std::function<const std::string&()>& shop);
  /// The runs that have ended with units since the last call.
  std::vector<std::uint64_t> take_finished();

  const std::list<PlanRun>& all() const { return runs_; }
  const PlanRun* find(std::uint64_t id) const;
  /// Throws InputError if the list does not have it.
  const PlanRun& at(std::uint64_t id) const;

 private:
  using Clock = std::chrono::steady_clock;

  PlanRun& run_of_id(std::uint64_t id);
  void begin(PlanRun& run, const std::string& shop);
  void end();
  void look();
  std::string free_folder() const;
  void save() const;
  void load();
  void add_listed(const Json& entry);
  void take_up(PlanRun& run);
  void take_result(PlanRun& run, RunState state, Json result);

  const std::filesystem::path folder_;
  const std::string program_;
  std::list<PlanRun> runs_;  // the newest last
  std::uint64_t last_id_ = 0;
  PlanRun* active_ = nullptr;
  std::optional<RunProcess> process_;
  std::vector<std::uint64_t> changed_, finished_;
  std::set<std::uint64_t> renewed_;
  std::unordered_map<std::string, std::int64_t> refused_;  // folders that are no plans, and their times
  Clock::time_point looked_{};
};

}  // namespace shelfbeam::serve
