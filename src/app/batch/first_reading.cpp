#include "app/batch/first_reading.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <list>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "shelfbeam/base/error.hpp"

#include "app/text/flags.hpp"
#include "app/verbs.hpp"
#include "jobs/child.hpp"
#include "jobs/event.hpp"

namespace shelfbeam::app {

namespace {

// The exit code of the process that reads a store; an error is reported as that of a job.
int outcome_of(const std::function<void(const ListedStore&)>& read, const ListedStore& store) {
  try {
    read(store);
    return done;
  } catch (const InputError& error) {
    const jobs::JobError end = job_error(error, error.setting());
    const std::string line = jobs::line_of(end);
    return ::write(STDOUT_FILENO, line.data(), line.size()) < 0 ? internal_error : end.code;
  } catch (const std::exception&) {
    return internal_error;
  }
}

struct Reading {
  std::size_t plan;
  jobs::Child child;
};

}  // namespace

std::vector<StoreResult> remove_unreadable(const BatchOptions& options, std::vector<OpenPlan>& plans,
                                           const std::function<void(const ListedStore&)>& read,
                                           const RunControl& control) {
  std::vector<StoreResult> failures;
  std::vector<bool> is_unreadable(plans.size());
  std::list<Reading> running;
  const auto note = [&](std::size_t k, const jobs::ChildEnd& end) {
    const auto found = end.exit_code == wrong_input ? jobs::read_end(end.out) : std::nullopt;
    const auto* error = found ? std::get_if<jobs::JobError>(&*found) : nullptr;
    if (error == nullptr) return;
    StoreRecord record{failed_result(*plans[k].store, error->message), plans[k].input};
    record.result.effort = with_run(plans[k].effort, end);
    try {
      write_record(options.folder, record);
    } catch (const InputError&) {
      return;  // as the plan will find
    }
    is_unreadable[k] = true;
    failures.push_back(std::move(record.result));
  };
  for (std::size_t next = 0; next < plans.size() || !running.empty();) {
    if (control.cancelled()) break;
    control.report(Task::reading_the_stores, static_cast<double>(next) / static_cast<double>(plans.size()));
    for (; next < plans.size() && running.size() < options.jobs; ++next) try {
        const ListedStore& store = *plans[next].store;
        running.push_back({next, jobs::Child([&read, &store] { return outcome_of(read, store); },
                                             options.memory / options.jobs)});
      } catch (const std::system_error&) {  // the plan will read it
      }
    if (!running.empty()) jobs::wait_for_children(jobs::poll_s);
    for (auto reading = running.begin(); reading != running.end();) {
      jobs::ChildEnd end;
      const bool has_ended = reading->child.has_ended(end);
      if (has_ended) note(reading->plan, end);
      reading = has_ended ? running.erase(reading) : std::next(reading);
    }
  }
  std::vector<OpenPlan> readable;
  for (std::size_t k = 0; k < plans.size(); ++k)
    if (!is_unreadable[k]) readable.push_back(std::move(plans[k]));
  plans = std::move(readable);
  std::sort(failures.begin(), failures.end(),
            [](const StoreResult& a, const StoreResult& b) { return a.name < b.name; });
  return failures;
}

}  // namespace shelfbeam::app
