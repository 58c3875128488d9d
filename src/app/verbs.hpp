#pragma once

#include <cstdint>
#include <functional>

#include <CLI/CLI.hpp>

#include "shelfbeam/base/control.hpp"

#include "jobs/exit_code.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::app {

using enum jobs::ExitCode;

/// Options that every verb has.
struct CommonOptions {
  std::uint64_t seed = 1;
  unsigned threads = 0;
  bool quiet = false;
  bool json = false;
};

/// The verb that the command line chose, ready to run; returns the exit code.
using ChosenVerb = std::function<int()>;

// Each function adds one verb with its options and examples to the command line. To add a verb, write `add_x`
// in its own file and call it in main.cpp.
void add_new(CLI::App& app, ChosenVerb& chosen);
void add_inspect(CLI::App& app, ChosenVerb& chosen);
void add_simulate(CLI::App& app, ChosenVerb& chosen);
void add_merge(CLI::App& app, ChosenVerb& chosen);
void add_place(CLI::App& app, ChosenVerb& chosen);
void add_plan(CLI::App& app, ChosenVerb& chosen);
void add_batch(CLI::App& app, ChosenVerb& chosen);
void add_preview(CLI::App& app, ChosenVerb& chosen);
void add_verify(CLI::App& app, ChosenVerb& chosen);
void add_report(CLI::App& app, ChosenVerb& chosen);
void add_compare(CLI::App& app, ChosenVerb& chosen);
void add_diff(CLI::App& app, ChosenVerb& chosen);
void add_export(CLI::App& app, ChosenVerb& chosen);
void add_serve(CLI::App& app, ChosenVerb& chosen);
/// Hidden from the help; for other programs (docs/formats/job.md).
void add_job(CLI::App& app, ChosenVerb& chosen);
/// Hidden from the help; for the planner (jobs/preview/light_job.hpp).
void add_light(CLI::App& app, ChosenVerb& chosen);
/// Hidden from the help; for the planner.
void add_archive(CLI::App& app, ChosenVerb& chosen);

/// Runs a plan, shows its progress and prints its result; returns the exit code.
int run_and_print(const jobs::PlanJob& job, const CommonOptions& common);

/// The plan of a command line. Throws as parse_command_line.
jobs::PlanJob parsed_plan(int argc, const char* const* argv);

}  // namespace shelfbeam::app
