#include <csignal>
#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/error.hpp"

#include "app/text/end_at_once.hpp"
#include "app/text/flags.hpp"
#include "app/text/pipe.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/event.hpp"
#include "jobs/plan_job_json.hpp"
#include "jobs/preview/first_answer.hpp"

namespace shelfbeam::app {

using namespace jobs;

namespace {

constexpr std::size_t max_request = std::size_t{1} << 20;

// If the reader has ended, the job continues without events.
void print(std::string_view line) {
  write_at_once(line);
}

JobEnd run_and_report() {
  EventProgress progress(print);
  const CancelToken& cancel = cancel_on_signal();
  std::signal(SIGPIPE, SIG_IGN);
  PlanJob job;
  try {
    job = parse_plan_job(standard_input(max_request, "pass a single job as JSON"), "job");
    std::optional<EndAtOnce> reading(stopped_early);
    const JobWatch watch{
        .cancel = &cancel, .progress = job.reports_progress ? &progress : nullptr, .read = [&] {
          reading.reset();
          if (job.reports_progress) print(store_is_read);
        }};
    const PlanEnd end = job.preview ? run_first_answer(job, watch) : run_plan(job, watch);
    return JobResult{summary_of(end), end.plan.complete};
  } catch (const InputError& error) {
    return job_error(error, error.setting());
  } catch (const Interrupted& error) {
    return job_error(error, error.setting());
  } catch (const std::exception& error) {
    JobError end = error_of(error);
    end.message =
        one_line(end.code == out_of_memory ? lack_of_memory(job.store.string(), "plan") : end.message);
    return end;
  }
}

}  // namespace

void add_job(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("job", "Run a job of another program: JSON in, lines of JSON out");
  verb->callback([&chosen] {
    chosen = [] {
      const JobEnd end = run_and_report();
      print(line_of(end));
      return static_cast<int>(exit_code_of(end));
    };
  });
}

}  // namespace shelfbeam::app
