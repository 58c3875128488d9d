#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/cores.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/batch/batch_report.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "app/batch/first_reading.hpp"
#include "app/batch/own_files.hpp"
#include "app/batch/run_batch.hpp"
#include "app/batch/slurm.hpp"
#include "app/options/arguments.hpp"
#include "app/options/usage.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/child.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::app {

using namespace jobs;
namespace fs = std::filesystem;

namespace {

constexpr const char* open_name = "open";  ///< with --only

struct BatchArguments {
  CommonOptions common;
  fs::path source, output;
  std::vector<std::string> plan;
  unsigned jobs = 0;
  std::size_t memory = 0;
  std::vector<StoreStatus> only;
  bool only_open = false;  ///< planned stores with a gap
  std::optional<Share> part;
  bool resume = false, overwrite = false, collect = false, slurm = false, safe_csv = false;
  std::uint32_t tasks = 1000;
  std::string task_time;
  std::vector<std::string> sbatch;

  /// Whether stores are chosen by their results.
  bool chooses() const { return only_open || !only.empty(); }
  bool chooses(const StoreResult& result) const {
    return std::find(only.begin(), only.end(), result.status) != only.end() ||
           (only_open && result.is_open());
  }
};

void print_warning(const BatchArguments& options, std::string_view text) {
  if (!options.common.quiet)
    print_message("{} {}\n", styled(Style::warning, "warning:", stderr), one_line(text));
}

// Reports errors in the options of `plan` once, before any plan.
PlanJob plan_of(const std::vector<std::string>& options) {
  for (const std::string& option : options)
    if (std::set<std::string>{"--quiet", "--json", "-h", "--help"}.contains(option))
      throw InputError(fmt::format("plan {}", option), "does not apply to the plans of a batch", "omit it");
  // With the options that the batch sets itself, which are then refused as duplicates.
  std::vector<std::string> words{"shelfbeam",   "plan",   "STORE", "-o",        "PLAN", "--resume",
                                 "--overwrite", "--seed", "1",     "--threads", "1"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<const char*> pointers;
  pointers.reserve(words.size());
  for (const std::string& word : words) pointers.push_back(word.c_str());
  try {
    return parsed_plan(static_cast<int>(pointers.size()), pointers.data());
  } catch (const WrongUsage& error) {
    throw InputError("options of 'plan'", error.what());
  } catch (const CLI::Success&) {
    throw InputError("options of 'plan'", "ask for help", "omit '--help'");
  }
}

// A folder of an earlier batch is used only on request.
void expect_folder(const BatchArguments& options) {
  std::error_code missing;
  const bool has_records = fs::exists(options.output / records_name, missing);
  if (options.collect && !has_records && !fs::exists(options.output / tasks_name, missing))
    throw InputError(options.output.string(), "has no results of a batch",
                     "check the path of the folder, or plan the stores first");
  if (!has_records || options.resume || options.overwrite || options.collect || options.part ||
      options.chooses())
    return;
  throw InputError(
      options.output.string(), "contains the results of an earlier batch",
      "add '--resume' to continue it, '--only failed' to plan failed stores again, or '--overwrite' "
      "to plan all stores again");
}

// Their plans begin anew.
void forget_results(const BatchArguments& options, const BatchOptions& batch) {
  for (const ListedStore& store : batch.stores) {
    const auto is_chosen = [&] {
      if (options.overwrite) return true;
      if (!options.chooses()) return false;
      const auto record = read_record(batch.folder, store);
      return record && options.chooses(record->result);
    };
    std::error_code missing;
    if (is_chosen()) fs::remove(batch.folder.record(store.name), missing);
  }
}

BatchOptions batch_options(const BatchArguments& options) {
  constexpr std::size_t least_memory = std::size_t{512} << 20;  // of one plan
  BatchOptions batch;
  StoreList list = listed_stores(options.source, options.output);
  for (const std::string& remark : list.remarks) print_warning(options, remark);
  batch.stores = std::move(list.stores);
  batch.folder.path = options.output;
  batch.plan_options = options.plan;
  batch.plan = plan_of(options.plan);
  batch.plan.plan.seed = options.common.seed;
  batch.plan.overwrite = true;
  batch.plan.reports_progress = false;
  batch.seed = options.common.seed;
  batch.threads = options.common.threads != 0 ? options.common.threads : std::min(core_count(), 256U);
  batch.memory = options.memory != 0 ? options.memory : memory_limit();
  batch.jobs = options.jobs != 0 ? options.jobs : batch.threads;
  batch.jobs =
      std::min(batch.jobs, static_cast<unsigned>(std::max<std::size_t>(1, batch.memory / least_memory)));
  batch.safe_csv = options.safe_csv;
  batch.keeps_answers = options.chooses();
  if (options.part) {
    std::vector<ListedStore> own;
    for (std::size_t k = options.part->number - 1; k < batch.stores.size(); k += options.part->count)
      own.push_back(batch.stores[k]);
    batch.stores = std::move(own);
  }
  return batch;
}

int print_results(const BatchArguments& options, const std::vector<StoreResult>& results) {
  const auto count = [&](StoreStatus status) {
    return std::count_if(results.begin(), results.end(),
                         [&](const StoreResult& result) { return result.status == status; });
  };
  if (options.common.json) {
    nlohmann::ordered_json counts;
    for (const auto& [name, status] : names_of<StoreStatus>) counts[std::string(name)] = count(status);
    print_json({{"results", (options.output / database_name).string()}, {"stores", counts}});
  } else if (!options.common.quiet) {
    fmt::print("{}\nresults: {}\n", styled(Style::answer, batch_answer(english(), results)),
               (options.output / page_name).string());
    if (count(StoreStatus::failed) > 0)
      fmt::print("  '--only failed' plans the failed stores again, after their files are corrected\n");
    if (count(StoreStatus::undecided) > 0)
      fmt::print("  '--only undecided -- --budget SECONDS' gives undecided plans more time\n");
    if (std::any_of(results.begin(), results.end(), [](const StoreResult& one) { return one.is_open(); }))
      fmt::print("  '--only open -- --budget SECONDS' gives plans that may be too large more time\n");
  }
  return count(StoreStatus::planned) == static_cast<std::ptrdiff_t>(results.size()) ? done : answer_is_no;
}

int run_on_slurm(const BatchArguments& options, const BatchOptions& batch) {
  std::error_code unknown;
  const fs::path folder = fs::absolute(options.output);
  const std::vector<std::string> common{fs::read_symlink(own_program, unknown).string(),
                                        "batch",
                                        fs::absolute(options.source).string(),
                                        "-o",
                                        folder.string(),
                                        "--seed",
                                        fmt::format("{}", options.common.seed)};
  SlurmBatch tasks;
  tasks.threads = std::max(1U, options.common.threads);
  tasks.memory = options.memory;
  tasks.time = options.task_time;
  tasks.options = options.sbatch;
  tasks.folder = folder;
  tasks.tasks = static_cast<std::uint32_t>(std::min<std::size_t>(options.tasks, batch.stores.size()));
  tasks.command = common;
  tasks.command.insert(tasks.command.end(), {"--threads", fmt::format("{}", tasks.threads), "--jobs", "1"});
  if (options.memory > 0)
    tasks.command.insert(tasks.command.end(), {"--memory", fmt::format("{}", options.memory)});
  tasks.command.emplace_back("--");
  tasks.command.insert(tasks.command.end(), options.plan.begin(), options.plan.end());
  tasks.collection = common;
  tasks.collection.emplace_back("--collect");
  if (options.safe_csv) tasks.collection.emplace_back("--safe-csv");
  const SlurmJobs jobs = submit(tasks);
  if (options.common.json)
    print_json({{"job", jobs.array}, {"results_job", jobs.collection}, {"tasks", tasks.tasks}});
  else if (!options.common.quiet)
    fmt::print("{} stores in {} tasks are queued as job {}; after it, job {} writes {}\n",
               batch.stores.size(), tasks.tasks, jobs.array, jobs.collection, (folder / page_name).string());
  return done;
}

void report_unplanned(const BatchArguments& options, const std::vector<StoreResult>& stores) {
  constexpr std::size_t most = 20;
  for (std::size_t k = 0; k < std::min(most, stores.size()); ++k)
    print_warning(options, fmt::format("{} is not planned: {}", in_quotes(stores[k].name), stores[k].answer));
  if (stores.size() > most)
    print_warning(options, fmt::format("{} cannot be planned", counted(stores.size() - most, "other store")));
}

int show_results(const BatchArguments& options, const BatchOptions& batch,
                 const std::vector<StoreResult>& unrecorded = {}) {
  const auto results = batch_results(batch, unrecorded);
  try {
    write_results(batch, results);
  } catch (const OutputError& error) {
    throw OutputError(error, "the records of the plans remain, and '--collect' writes the results",
                      Setting::none);
  }
  return print_results(options, results);
}

int collect(const BatchArguments& options, const BatchOptions& batch) {
  const int code = show_results(options, batch);
  for (const ListedStore& store : batch.stores)
    if (const auto record = read_record(batch.folder, store); record && !record->damage.empty())
      throw InputError("", record->damage, "plan its store again", Setting::resumption);
  return code;
}

// Plans the stores, and writes the results so far now and then.
BatchEnd plan_stores(const BatchArguments& options, const BatchOptions& batch, const CancelToken& cancel) {
  std::vector<OpenPlan> plans = open_plans(batch);
  std::vector<StoreResult> unreadable;
  {
    TerminalProgress progress(options.common.quiet);
    const auto read = [&](const ListedStore& store) {
      read_scene(store.file, {.allow_outside = batch.plan.allow_outside});
    };
    unreadable = remove_unreadable(batch, plans, read, {batch.threads, &cancel, progress.sink()});
  }
  report_unplanned(options, unreadable);
  if (options.slurm) return {!cancel.requested(), {}};
  using Clock = std::chrono::steady_clock;
  auto next = Clock::now() + std::chrono::minutes(unreadable.empty() ? 1 : 0);
  const auto write_some = [&] {
    if (options.part || Clock::now() < next) return;
    const auto begun = Clock::now();
    try {
      write_results(batch, batch_results(batch));
    } catch (const InputError&) {  // reported at the end, if the reason is still there
    }
    next = Clock::now() + std::max<Clock::duration>(std::chrono::minutes(1), 100 * (Clock::now() - begun));
  };
  write_some();
  TerminalProgress progress(options.common.quiet);
  return run_batch(batch, plans, write_some, {batch.threads, &cancel, progress.sink()});
}

int run_batch_verb(const BatchArguments& options) {
  const CancelToken& cancel = cancel_on_signal();
  const BatchOptions batch = batch_options(options);
  expect_folder(options);
  make_output_folder(options.output);
  std::optional<OutputLock> lock;
  if (!options.part) {
    lock.emplace(options.output / database_name, options.output.string());
    const std::vector<std::string> results{database_name, table_name, page_name},
        scripts{tasks_name, collection_name};
    expect_own_files(options.output, options.slurm ? scripts : results, options.overwrite);
  }
  if (options.collect) return collect(options, batch);
  forget_results(options, batch);
  const BatchEnd end = plan_stores(options, batch, cancel);
  int code = done;
  if (options.part) {
    report_unplanned(options, end.unrecorded);
    code = end.unrecorded.empty() ? done : wrong_input;
  } else if (options.slurm && end.is_complete) {
    return run_on_slurm(options, batch);
  } else if (!options.slurm) {
    code = show_results(options, batch, end.unrecorded);
  }
  if (end.is_complete) return code;
  if (!options.common.quiet) print_message("stopped early: repeat the command with '--resume' to continue\n");
  return stopped_early;
}

}  // namespace

void add_batch(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("batch", "Plan many stores, and list the results, most urgent first");
  auto options = std::make_shared<BatchArguments>();
  const OptionGroup first(*verb), cluster(*verb, group::cluster);
  first.require("STORES", options->source, a_path(),
                "Text file with the path of a store file per line, or a folder with files called store.json");
  first.require("-o,--output", options->output, a_path(), "Folder for the results");
  verb->add_option("OPTIONS", options->plan, "After '--': options of 'plan' for all stores");
  first.add("--jobs", options->jobs, whole_number("N", 1, 256),
            "Maximum number of plans at a time; default: one per thread");
  first.add("--memory", options->memory, size_in_bytes(),
            "Memory of all plans together, e.g. 16G; default: 80 % of the memory that the program may use. "
            "A plan that needs more than its share runs again alone");
  first.add_flag(
      "--resume", options->resume,
      "Continue an interrupted batch; stores whose file or options have changed are planned again");
  const auto set_only = [options](const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (name == open_name)
        options->only_open = true;
      else
        options->only.push_back(from_text<StoreStatus>(name).value());
  };
  first
      .add_call<std::vector<std::string>>(
          "--only", set_only, one_of({"failed", "infeasible", "undecided", open_name}),
          "Plan the stores with this result again, and those without a result; open: planned stores for "
          "which fewer units, or a lower price, may be enough")
      ->delimiter(',')
      ->allow_extra_args(false);
  first.add_flag("--overwrite", options->overwrite,
                 "Plan all stores again, and replace results that were changed since");
  add_safe_csv(*verb, options->safe_csv);
  auto* slurm = cluster.add_flag("--slurm", options->slurm, "Queue the plans as a Slurm job array");
  cluster.add("--tasks", options->tasks, whole_number("N", 1, 100'000),
              fmt::format("With --slurm: maximum number of tasks in the array; default {}", options->tasks));
  cluster.add("--task-time", options->task_time, CLI::Validator("TIME"),
              "With --slurm: time limit of a task, as sbatch reads it, e.g. 2:00:00; a task that reaches it "
              "is continued from its checkpoints");
  cluster
      .add("--sbatch", options->sbatch, CLI::Validator("OPTION"),
           "With --slurm: an option of sbatch, e.g. --sbatch=--partition=long")
      ->allow_extra_args(false);
  for (const char* flag : {"--tasks", "--task-time", "--sbatch"}) verb->get_option(flag)->needs(slurm);
  const auto set_part = [options](const std::string& text) { options->part = share_of(text); };
  cluster
      .add_call<std::string>("--part", set_part, a_part(),
                             "Plan every N-th store only, from store K on, without writing the results; for "
                             "other workload managers")
      ->excludes(slurm)
      ->excludes("--overwrite")
      ->excludes("--only");
  cluster
      .add_flag("--collect", options->collect,
                "Write the results of the plans that are finished, and plan nothing")
      ->excludes(slurm)
      ->excludes("--part")
      ->excludes("--only");
  finish_verb(*verb, chosen, options, run_batch_verb,
              "Examples:\n"
              "  shelfbeam batch stores.txt -o results\n"
              "  shelfbeam batch shops/ -o results --memory 16G -- --samples 5000\n"
              "  shelfbeam batch shops/ -o results --only failed\n"
              "  shelfbeam batch shops/ -o results --slurm --task-time 2:00:00\n"
              "Writes results.html (start here), results.csv and results.sqlite, and the plan of\n"
              "each store below plans/.");
}

}  // namespace shelfbeam::app
