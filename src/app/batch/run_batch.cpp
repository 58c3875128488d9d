#include "app/batch/run_batch.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <list>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/report/batch/batch_report.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "app/batch/database.hpp"
#include "app/batch/own_files.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_process.hpp"

namespace shelfbeam::app {

namespace {

std::string input_of(const ListedStore& store, const BatchOptions& options) {
  std::string content;
  try {
    content = read_file(store.file);
  } catch (const InputError& error) {  // its plan will report it
    content = error.what();
  }
  return content_hash(fmt::format("{}\n{}\n{}\n{}", program_version(), options.seed,
                                  fmt::join(options.plan_options, "\n"), content));
}

// Plans whose batch was killed end a moment after it. Returns the reason for which the plan is still in use.
std::string wait_until_free(const std::filesystem::path& plan, const RunControl& control) {
  constexpr int attempts = 100;
  std::error_code missing;
  if (!std::filesystem::exists(plan, missing)) return {};
  for (int k = 0;; ++k) try {
      const OutputLock probe(plan / jobs::signal_name, plan.string());
      return {};
    } catch (const OutputError&) {  // its plan will report it
      return {};
    } catch (const InputError& error) {
      if (k == attempts || control.cancelled()) return error.what();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

bool is_finished(const BatchFolder& folder, const ListedStore& store, const std::string& input) {
  const auto record = read_record(folder, store);
  return record && record->is_final && record->input == input;
}

class Runner {
 public:
  Runner(const BatchOptions& options, const std::vector<OpenPlan>& plans,
         const std::function<void()>& finished, const RunControl& control)
      : options_(options),
        finished_(finished),
        control_(control),
        done_(options.stores.size() - std::min(plans.size(), options.stores.size())) {
    for (const OpenPlan& plan : plans) waiting_.push_back({plan});
  }

  BatchEnd run() {
    while (!running_.empty() || has_waiting()) {
      if (control_.cancelled()) {
        stop();
        break;
      }
      start_jobs();
      report();
      if (!running_.empty()) jobs::wait_for_children(jobs::poll_s);
      collect_ended();
    }
    return std::move(end_);
  }

 private:
  struct Job : OpenPlan {
    bool is_alone = false;
    unsigned threads = 1;
    std::optional<jobs::PlanProcess> process = {};
  };

  bool has_waiting() const { return !waiting_.empty() || !alone_.empty(); }

  unsigned free_threads() const {
    unsigned used = 0;
    for (const Job& job : running_) used += job.threads;
    return options_.threads - std::min(options_.threads, used);
  }

  // The last plans get the threads for which there are no others.
  void start_jobs() {
    while (!waiting_.empty() && running_.size() < options_.jobs) {
      const auto places = static_cast<unsigned>(options_.jobs - running_.size());
      const auto starting = std::min(places, static_cast<unsigned>(waiting_.size()));
      start(waiting_, std::max(1U, free_threads() / starting), options_.memory / options_.jobs);
    }
    if (running_.empty() && waiting_.empty() && !alone_.empty())
      start(alone_, options_.threads, options_.memory);
  }

  void start(std::deque<Job>& jobs, unsigned threads, std::size_t memory) {
    Job job = std::move(jobs.front());
    jobs.pop_front();
    job.threads = threads;
    try {
      if (launch(job, memory)) running_.push_back(std::move(job));
    } catch (const std::exception& error) {  // of this store's files
      fail(job, error.what());
    }
  }

  // False if the plan need not or cannot be made.
  bool launch(Job& job, std::size_t memory) {
    const ListedStore& store = *job.store;
    const std::filesystem::path plan = options_.folder.plan(store.name);
    make_output_folder(plan.parent_path());
    if (const std::string user = wait_until_free(plan, control_); !user.empty()) {
      fail(job, user);
      return false;
    }
    if (is_finished(options_.folder, store, job.input)) {  // by another run, which planned it meanwhile
      ++done_;
      return false;
    }
    if (!job.continues) write_record(options_.folder, {without_result(store), job.input});
    jobs::PlanJob plan_job = options_.plan;
    plan_job.store = store.file;
    plan_job.folder = plan;
    plan_job.threads = job.threads;
    plan_job.checkpoint.resume = job.continues;
    job.process.emplace(plan_job, memory);
    return true;
  }

  void fail(const Job& job, const std::string& reason) {
    StoreResult result = failed_result(*job.store, reason);
    result.effort = job.effort;
    end_.unrecorded.push_back(std::move(result));
    ++done_;
  }

  void collect_ended() {
    for (auto job = running_.begin(); job != running_.end();) {
      jobs::JobEnd end;
      jobs::ChildEnd effort;
      if (!job->process->has_ended(end, effort)) {
        ++job;
        continue;
      }
      finish(*job, end, effort);
      job = running_.erase(job);
    }
  }

  // Only the answer of a plan is final. A failure may have been due to a full disk or another program.
  void finish(Job& job, const jobs::JobEnd& end, const jobs::ChildEnd& effort) {
    const bool was_killed = effort.exit_code > 128;
    const auto* failure = std::get_if<jobs::JobError>(&end);
    const bool is_interrupted = failure != nullptr
                                    ? failure->is_interruption || (control_.cancelled() && was_killed)
                                    : !std::get<jobs::JobResult>(end).is_complete;
    StoreRecord record{
        is_interrupted ? without_result(*job.store) : result_of(options_.folder, *job.store, end), job.input};
    record.is_final = !is_interrupted && record.result.status != StoreStatus::failed;
    record.result.effort = job.effort = with_run(job.effort, effort);
    // A file that the store names, such as a mesh, may have changed.
    if (job.continues && failure != nullptr && failure->is_of_checkpoint) {
      waiting_.push_front({{job.store, job.input, job.effort, false}});
      return;
    }
    // A signal from the system may have the same reason.
    const bool may_lack_memory = failure != nullptr && (failure->code == out_of_memory || was_killed);
    if (!record.is_final && !is_interrupted && may_lack_memory && !job.is_alone && options_.jobs > 1) {
      alone_.push_back({{job.store, job.input, job.effort, true}, true});
      return;
    }
    try {
      if (record.is_final || !is_finished(options_.folder, *job.store, job.input))
        write_record(options_.folder, record);
    } catch (const InputError& error) {
      fail(job, error.what());
      return;
    }
    done_ += is_interrupted ? 0 : 1;
    finished_();
  }

  void stop() {
    end_.is_complete = false;
    for (Job& job : running_) job.process->interrupt();
    while (!running_.empty()) {
      jobs::wait_for_children(jobs::poll_s);
      collect_ended();
    }
  }

  void report() const {
    std::vector<std::string> names;
    for (const Job& job : running_) names.push_back(job.store->name);
    control_.report(
        Task::planning, static_cast<double>(done_) / static_cast<double>(options_.stores.size()),
        fmt::format("{} of {} stores, now {}", done_, options_.stores.size(), fmt::join(names, ", ")));
  }

  const BatchOptions& options_;
  const std::function<void()>& finished_;
  const RunControl& control_;
  std::deque<Job> waiting_, alone_;
  std::list<Job> running_;
  std::size_t done_;
  BatchEnd end_;
};

}  // namespace

std::vector<OpenPlan> open_plans(const BatchOptions& options) {
  std::vector<OpenPlan> plans;
  for (const ListedStore& store : options.stores) {
    OpenPlan plan{&store, input_of(store, options), {}};
    const auto record = read_record(options.folder, store);
    plan.continues = record && record->input == plan.input;
    if (record && record->is_final && (plan.continues || options.keeps_answers)) continue;
    if (plan.continues) plan.effort = record->result.effort;
    plans.push_back(std::move(plan));
  }
  return plans;
}

BatchEnd run_batch(const BatchOptions& options, const std::vector<OpenPlan>& plans,
                   const std::function<void()>& finished, const RunControl& control) {
  return Runner(options, plans, finished, control).run();
}

std::vector<StoreResult> batch_results(const BatchOptions& options, const std::vector<StoreResult>& others) {
  std::vector<StoreResult> results;
  for (const ListedStore& store : options.stores) {
    const auto other = std::find_if(others.begin(), others.end(),
                                    [&](const StoreResult& result) { return result.name == store.name; });
    if (other != others.end()) {
      results.push_back(*other);
      continue;
    }
    const auto record = read_record(options.folder, store);
    results.push_back(record ? record->result : without_result(store));
  }
  sort_by_need(results);
  return results;
}

void write_results(const BatchOptions& options, const std::vector<StoreResult>& results) {
  replace_own_files(options.folder.path, {{database_name, database_of(results)},
                                          {table_name, batch_csv(results, options.safe_csv)},
                                          {page_name, batch_html(english(), results)}});
}

}  // namespace shelfbeam::app
