#include "serve/planning/run_process.hpp"

#include <chrono>
#include <system_error>
#include <utility>
#include <variant>

#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/names.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include "jobs/event.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_job_json.hpp"

namespace shelfbeam::serve {

namespace {

constexpr std::chrono::seconds patience_of_plan{60};

// A request with the paths of the project.
jobs::PlanJob job_of(const PlanRun& run, const std::filesystem::path& store) {
  const std::filesystem::path folder = store.parent_path();
  Json request = run.plan;
  if (request.contains("constraints"))
    for (const char* key : {"costs", "forbidden"})
      if (request["constraints"].contains(key))
        for (Json& file : request["constraints"][key])
          file = (folder / std::filesystem::path(file.get<std::string>()).filename()).string();
  jobs::PlanJob job = jobs::parse_plan_job(
      Json{{"store", "store.json"}, {"folder", run.folder}, {"plan", request}}.dump(), "plan");
  job.store = store;
  job.folder = folder / run.folder;
  return job;
}

}  // namespace

void expect_request(const PlanRun& run) {
  job_of(run, "store.json");
}

RunProcess::RunProcess(PlanRun& run, const std::filesystem::path& store, const std::string& signal,
                       std::string program)
    : run_(run), job_(job_of(run, store)), program_(std::move(program)) {
  const std::filesystem::path folder = store.parent_path();
  if (!signal.empty()) job_.signal = folder / signal;
  job_.is_signal_optional = true;
  std::error_code ignored;
  job_.checkpoint.resume =
      std::filesystem::exists(checkpoint_path(folder / run.folder / jobs::signal_name), ignored);
  if (run.first.is_null()) job_.preview = folder / ".shelfbeam";
  start();
}

void RunProcess::start() {
  run_.state = job_.preview ? RunState::previewing : RunState::running;
  run_.progress = {};
  withheld_.reset();
  selected_.clear();
  stages_ = {};
  begun_ = std::chrono::steady_clock::now();
  has_changed_ = true;
  try {
    process_.emplace(job_, memory_limit(), program_);
    process_->give_way();
  } catch (const std::exception& error) {
    process_.reset();
    run_.fail(error);
  }
}

void RunProcess::cancel() {
  // A second signal would end the process without its results.
  if (std::exchange(is_cancelled_, true) || !process_) return;
  process_->interrupt(patience_of_plan);
}

bool RunProcess::poll() {
  jobs::JobEnd result;
  jobs::ChildEnd effort;
  const bool has_ended = process_ && process_->has_ended(result, effort, this);
  if (has_ended) end(result);
  return std::exchange(has_changed_, false);
}

void RunProcess::end(const jobs::JobEnd& end) {
  process_.reset();
  has_changed_ = true;
  const Json event = Json::parse(jobs::line_of(end));
  const auto* error = std::get_if<jobs::JobError>(&end);
  if (job_.preview) {
    job_.preview.reset();
    // The plan reports its own error.
    if (error == nullptr) run_.first = event;
    if (!is_cancelled_) return start();
    run_.state = RunState::stopped;
    return;
  }
  run_.result = event;
  if (error != nullptr)
    run_.state = is_cancelled_ ? RunState::stopped : RunState::failed;
  else
    run_.state = std::get<jobs::JobResult>(end).is_complete ? RunState::done : RunState::stopped;
}

void RunProcess::report(Task task, double fraction, std::string_view detail) {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begun_;
  const jobs::Progress progress = stages_.update(task, fraction, detail, since.count());
  const auto known = [](double value) { return value < 0 ? std::nullopt : std::optional(value); };
  RunProgress& now = run_.progress;
  now.task = to_text(progress.task);
  now.detail = progress.detail;
  now.share = known(progress.fraction);
  now.seconds_left = known(progress.seconds_left);
  has_changed_ = true;
  const auto reported = std::exchange(reported_, {});
  const bool is_of_plan = progress.task == Task::placing || progress.task == Task::placing_over_states ||
                          progress.task == Task::proving;
  if (!is_of_plan) {
    // A later placement has ended with more units: the earlier ones are not enough.
    if (withheld_) take(*std::exchange(withheld_, {}));
    return;
  }
  // The placement over the states of a shop is another question than that for the shop as drawn.
  if (std::exchange(bounded_, progress.task) == Task::placing && progress.task == Task::placing_over_states) {
    now.bound.reset();
    now.incumbent.reset();
  }
  if (!reported) return;
  // Every placement begins with a quick selection.
  Incumbent found{reported->first, reported->second, selected_};
  const double sign = run_.plan.contains("at_most") ? -1 : 1;
  if (now.incumbent && sign * (found.value - *now.incumbent) > 0) {
    withheld_ = std::move(found);
  } else {
    withheld_.reset();
    take(found);
  }
}

void RunProcess::take(const Incumbent& found) {
  run_.progress.selected = found.selected;
  run_.progress.take_bounds(found.value, found.bound, run_.plan.contains("at_most"));
}

void RunProcess::bounds(double incumbent, double lower_bound) {
  reported_ = {incumbent, lower_bound};
}

void RunProcess::selection(const std::vector<std::string>& ids) {
  selected_ = ids;
}

}  // namespace shelfbeam::serve
