#include "app/batch/run_batch.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
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

#include "app/batch/child.hpp"
#include "app/batch/database.hpp"
#include "app/plan_folder.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

// An interval in which an ended plan, or a signal, is always noticed.
constexpr double poll_s = 0.5;

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

// Plans whose batch was killed end a moment after it.
void wait_until_free(const std::filesystem::path& plan) {
  constexpr int attempts = 100;
  std::error_code missing;
  if (!std::filesystem::exists(plan, missing)) return;
  for (int k = 0; k < attempts; ++k) try {
      const OutputLock probe(plan / signal_name, plan.string());
      return;
    } catch (const InputError&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

class Runner {
 public:
  Runner(const BatchOptions& options, const std::function<void()>& finished, const RunControl& control)
      : options_(options), finished_(finished), control_(control) {
    for (const ListedStore& store : options.stores) {
      Job job{&store, input_of(store, options_), {}};
      if (const auto record = read_record(options_.folder, store)) {
        if (record->is_final && record->input == job.input) {
          ++done_;
          continue;
        }
        job.continues = record->input == job.input;
        if (job.continues) job.effort = record->result.effort;
      }
      waiting_.push_back(std::move(job));
    }
  }

  bool run() {
    while (!running_.empty() || has_waiting()) {
      if (control_.cancelled()) return stop();
      start_jobs();
      report();
      wait_for_children(poll_s);
      collect_ended();
    }
    return true;
  }

 private:
  struct Job {
    const ListedStore* store;
    std::string input;
    PlanEffort effort;       ///< of earlier runs
    bool continues = false;  ///< whether its checkpoints are of the same input
    bool is_alone = false;
    unsigned threads = 1;
    std::optional<Child> child = {};
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
    const std::filesystem::path plan = options_.folder.plan(job.store->name);
    make_output_folder(plan.parent_path());
    wait_until_free(plan);
    if (!job.continues) write_record(options_.folder, {without_result(*job.store), job.input, false});
    std::vector<std::string> words{
        own_program,   "plan",   job.store->file.string(),         "-o",        plan.string(),
        "--overwrite", "--seed", fmt::format("{}", options_.seed), "--threads", fmt::format("{}", threads)};
    if (job.continues) words.emplace_back("--resume");
    words.insert(words.end(), options_.plan_options.begin(), options_.plan_options.end());
    job.child.emplace(std::move(words), memory);
    running_.push_back(std::move(job));
  }

  void collect_ended() {
    for (auto job = running_.begin(); job != running_.end();) {
      ChildEnd end;
      if (!job->child->has_ended(end)) {
        ++job;
        continue;
      }
      finish(*job, end);
      job = running_.erase(job);
    }
  }

  void finish(Job& job, const ChildEnd& end) {
    StoreRecord record;
    record.input = job.input;
    record.is_final = !control_.cancelled() || end.exit_code != stopped_early;
    record.result = result_of(options_.folder, *job.store, end);
    if (!record.is_final) record.result = without_result(*job.store);
    PlanEffort& effort = record.result.effort;
    effort = job.effort;
    effort.cpu_s += end.cpu_s;
    effort.wall_s += end.wall_s;
    effort.peak_memory = std::max(effort.peak_memory, end.peak_memory);
    ++effort.runs;
    if (record.is_final && may_lack_memory(end) && !job.is_alone && options_.jobs > 1) {
      alone_.push_back({job.store, job.input, effort, true, true});
      return;
    }
    write_record(options_.folder, record);
    done_ += record.is_final ? 1 : 0;
    finished_();
  }

  // Also ended by the system, for which memory is the usual reason.
  static bool may_lack_memory(const ChildEnd& end) {
    return end.exit_code > 128 ||
           (end.exit_code == wrong_input && end.err.find("memory") != std::string::npos);
  }

  bool stop() {
    for (const Job& job : running_) job.child->interrupt();
    while (!running_.empty()) {
      wait_for_children(poll_s);
      collect_ended();
    }
    return false;
  }

  void report() const {
    std::vector<std::string> names;
    for (const Job& job : running_) names.push_back(job.store->name);
    control_.report(
        "planning", static_cast<double>(done_) / static_cast<double>(options_.stores.size()),
        fmt::format("{} of {} stores, now {}", done_, options_.stores.size(), fmt::join(names, ", ")));
  }

  const BatchOptions& options_;
  const std::function<void()>& finished_;
  const RunControl& control_;
  std::deque<Job> waiting_, alone_;
  std::list<Job> running_;
  std::size_t done_ = 0;
};

}  // namespace

bool run_batch(const BatchOptions& options, const std::function<void()>& finished,
               const RunControl& control) {
  return Runner(options, finished, control).run();
}

std::vector<StoreResult> batch_results(const BatchOptions& options) {
  std::vector<StoreResult> results;
  for (const ListedStore& store : options.stores) {
    const auto record = read_record(options.folder, store);
    results.push_back(record ? record->result : without_result(store));
  }
  sort_by_need(results);
  return results;
}

void write_results(const BatchOptions& options, const std::vector<StoreResult>& results) {
  AtomicFolder files(options.folder.path);
  files.add(database_name).write(database_of(results));
  files.add(table_name).write(batch_csv(results, options.safe_csv));
  files.add(page_name).write(batch_html(results));
  files.commit({});
}

}  // namespace shelfbeam::app
