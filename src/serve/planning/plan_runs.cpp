#include "serve/planning/plan_runs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "jobs/event.hpp"
#include "jobs/plan_folder.hpp"
#include "serve/live/newest_plan.hpp"
#include "serve/project/record.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t max_list = 64 << 20;
constexpr auto list_name = "plans.json";
constexpr int list_format = 1;

// PlanRun::written of the plan in a folder.
std::int64_t written_in(const fs::path& folder) {
  const auto time = time_of_plan(folder);
  return time ? std::chrono::duration_cast<std::chrono::nanoseconds>(time->time_since_epoch()).count() : 0;
}

std::string present_time() {
  return utc_text(std::chrono::system_clock::now());
}

// Whether two events `result` are of the same plan, whatever they say of it.
bool has_same_numbers(const Json& one, const Json& other) {
  if (!one.is_object() || !other.is_object()) return false;
  constexpr std::array keys{"complete", "labels", "units", "lower_bound", "price", "currency", "selected"};
  return std::ranges::all_of(
      keys, [&](const char* key) { return one.value(key, Json()) == other.value(key, Json()); });
}

}  // namespace

PlanRuns::PlanRuns(fs::path folder, std::string program)
    : folder_(std::move(folder)), program_(std::move(program)) {
  load();
}

PlanRuns::~PlanRuns() {
  if (!process_) return;
  // The samples since the last checkpoint are worth a moment.
  constexpr auto patience = std::chrono::seconds(5);
  const auto begin = std::chrono::steady_clock::now();
  process_->cancel();
  while (active_->is_active() && std::chrono::steady_clock::now() - begin < patience) {
    jobs::wait_for_children(0.1);
    process_->poll();
  }
  if (active_->state != RunState::done) return;  // it continues with the next program
  try {
    end();
  } catch (const std::exception&) {
    // The next program finds the plan in its folder.
  }
}

// A run whose units are those in its folder.
void PlanRuns::take_result(PlanRun& run, RunState state, Json result) {
  run.state = state;
  run.result = std::move(result);
  run.written = written_in(folder_ / run.folder);
  if (run.has_plan()) finished_.push_back(run.id);
}

// A run that has not ended for this list.
void PlanRuns::take_up(PlanRun& run) {
  Json result = result_in(folder_ / run.folder);
  if (result.is_object() && result["complete"] == true)
    return take_result(run, RunState::done, std::move(result));
  if (run.is_cancelled) return take_result(run, RunState::stopped, std::move(result));
  run.is_continued = run.state != RunState::waiting;
  run.state = RunState::waiting;
}

void PlanRuns::add_listed(const Json& entry) {
  try {
    PlanRun run = run_of(entry);
    if (find(run.id) != nullptr) return;
    if (run.is_active()) take_up(run);
    last_id_ = std::max(last_id_, run.id);
    runs_.push_back(std::move(run));
  } catch (const std::exception&) {
    // The plan itself is in its folder.
  }
}

// A damaged list, or that of a later version, does not prevent the project from opening; it is kept.
void PlanRuns::load() {
  const fs::path file = folder_ / ".shelfbeam" / list_name;
  if (!is_plain_file(file)) return;
  try {
    const Json json = Json::parse(read_file(file, max_list));
    if (json.at("format") == list_format) {
      for (const Json& entry : json.at("runs")) add_listed(entry);
      return;
    }
  } catch (const std::exception&) {
    // as below
  }
  std::error_code ignored;
  fs::rename(file, file.string() + ".unreadable", ignored);
}

void PlanRuns::save() const {
  Json list = Json::array();
  for (const PlanRun& run : runs_) list.push_back(to_json(run));
  const Json json{{"format", list_format}, {"runs", std::move(list)}};
  write_file(folder_ / ".shelfbeam" / list_name,
             json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

// The first name of "plan", "plan-2", ... that neither the folder nor a run has.
std::string PlanRuns::free_folder() const {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    std::string name = number == 1 ? "plan" : fmt::format("plan-{}", number);
    const bool is_taken =
        std::any_of(runs_.begin(), runs_.end(), [&](const PlanRun& run) { return run.folder == name; });
    if (!is_taken && fs::symlink_status(folder_ / name, ignored).type() == fs::file_type::not_found)
      return name;
  }
}

std::uint64_t PlanRuns::add(Json plan, std::string shop) {
  PlanRun run{.id = last_id_ + 1, .folder = free_folder(), .plan = std::move(plan), .shop = std::move(shop)};
  expect_request(run);
  run.begun = present_time();
  runs_.push_back(std::move(run));
  changed_.push_back(++last_id_);
  save();
  return last_id_;
}

PlanRun& PlanRuns::run_of_id(std::uint64_t id) {
  return const_cast<PlanRun&>(at(id));  // of runs_
}

const PlanRun& PlanRuns::at(std::uint64_t id) const {
  if (const PlanRun* run = find(id)) return *run;
  throw InputError("plan", "is not in the list", "reload the page");
}

const PlanRun* PlanRuns::find(std::uint64_t id) const {
  const auto found =
      std::find_if(runs_.begin(), runs_.end(), [&](const PlanRun& run) { return run.id == id; });
  return found == runs_.end() ? nullptr : &*found;
}

void PlanRuns::cancel(std::uint64_t id) {
  PlanRun& run = run_of_id(id);
  if (!run.is_active()) throw InputError("plan", "has ended already", "look at its result");
  run.is_cancelled = true;
  if (&run == active_) {
    process_->cancel();
  } else {
    run.state = RunState::stopped;
    run.ended = present_time();
  }
  changed_.push_back(id);
  save();
}

void PlanRuns::forget(std::uint64_t id) {
  const PlanRun& run = at(id);
  if (run.is_active() || run.has_plan())
    throw InputError("plan", "has a result", "delete its folder if it is not needed");
  runs_.remove_if([&](const PlanRun& one) { return one.id == id; });
  changed_.push_back(id);
  save();
}

void PlanRuns::note_entered(std::uint64_t id) {
  run_of_id(id).is_entered = true;
  changed_.push_back(id);
  save();
}

// A run that was interrupted continues with the samples of its shop, or not at all.
void PlanRuns::begin(PlanRun& run, const std::string& shop) {
  active_ = &run;
  try {
    if (run.is_continued && run.shop != shop) {
      // The best units of the interruption are worth more than an error.
      if (Json result = result_in(folder_ / run.folder); result.is_object()) {
        take_result(run, RunState::stopped, std::move(result));
        active_ = nullptr;
        run.ended = present_time();
        changed_.push_back(run.id);
        return save();
      }
      throw InputError("the shop", "has changed since the plan was interrupted", "start another plan");
    }
    run.shop = shop;
    run.state = RunState::running;
    process_.emplace(run, folder_ / "store.json", newest_plan(folder_), program_);
  } catch (const std::exception& error) {
    process_.reset();
    run.fail(error);
    end();
  }
  changed_.push_back(run.id);
  save();
}

void PlanRuns::end() {
  PlanRun& run = *std::exchange(active_, nullptr);
  process_.reset();
  run.ended = present_time();
  run.written = written_in(folder_ / run.folder);
  if (run.has_plan()) finished_.push_back(run.id);
  save();
}

// Finds the plans of other programs, one at a time.
void PlanRuns::look() {
  if (Clock::now() - looked_ < std::chrono::seconds(1)) return;
  looked_ = Clock::now();
  constexpr auto longest_look = std::chrono::milliseconds(50);
  bool has_found = false;
  std::error_code error;
  if (!fs::exists(folder_ / ".shelfbeam", error)) return;  // the folder itself may be gone for a while
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (entry.symlink_status(error).type() != fs::file_type::directory) continue;
    const std::string name = entry.path().filename().string();
    const std::int64_t written = written_in(entry.path());
    const auto refused = refused_.find(name);
    if (!is_utf8(name) || (refused != refused_.end() && refused->second == written)) continue;
    auto known =
        std::find_if(runs_.begin(), runs_.end(), [&](const PlanRun& run) { return run.folder == name; });
    if (written == 0 || (known != runs_.end() && (known->is_active() || known->written == written))) continue;
    const Json result = result_in(entry.path());
    if (known == runs_.end()) {
      if (result.is_null()) {
        refused_[name] = written;
        continue;
      }
      known = runs_.insert(runs_.end(), {.id = ++last_id_, .folder = name});
    }
    has_found = true;
    changed_.push_back(known->id);
    // A renewed report is of the same plan.
    if (renewed_.erase(known->id) > 0 && has_same_numbers(known->result, result)) {
      known->written = written;
      continue;
    }
    known->plan = nullptr;
    known->shop.clear();
    known->state = RunState::done;
    known->result = result;
    known->written = written;
    known->begun = known->ended = utc_text(
        fs::file_time_type::clock::to_sys(fs::last_write_time(entry.path() / jobs::placement_name, error)));
    if (Clock::now() - looked_ > longest_look) break;
  }
  if (has_found) return save();
  // A plan whose folder is gone.
  const auto gone = std::find_if(runs_.begin(), runs_.end(), [&](const PlanRun& run) {
    return !run.is_active() && run.written != 0 && written_in(folder_ / run.folder) == 0;
  });
  if (gone == runs_.end()) return;
  changed_.push_back(gone->id);
  runs_.erase(gone);
  save();
}

std::vector<std::uint64_t> PlanRuns::poll(const std::function<const std::string&()>& shop) {
  if (process_) {
    // The process may have read the store before the change, or after it.
    if (process_->may_start_again() && active_->shop != shop()) {
      active_->shop = shop();
      process_->start();
    }
    if (process_->poll()) changed_.push_back(active_->id);
    if (!active_->is_active()) end();
  }
  const auto next = std::find_if(runs_.begin(), runs_.end(),
                                 [](const PlanRun& run) { return run.state == RunState::waiting; });
  if (!process_ && next != runs_.end()) begin(*next, shop());
  look();
  return std::exchange(changed_, {});
}

std::vector<std::uint64_t> PlanRuns::take_finished() {
  return std::exchange(finished_, {});
}

}  // namespace shelfbeam::serve
