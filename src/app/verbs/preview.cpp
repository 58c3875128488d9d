#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/report/terminal/preview_text.hpp"

#include "app/options/arguments.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/preview/preview_job.hpp"

namespace shelfbeam::app {

namespace {

struct PreviewArguments {
  CommonOptions common;
  jobs::PreviewJob job;
};

int run_preview_verb(const PreviewArguments& options) {
  jobs::PreviewJob job = options.job;
  job.seed = options.common.seed;
  if (!job.plan.empty() && job.added.empty() && job.moved.empty() && job.removed.empty())
    throw InputError("preview", "has no unit", "add --unit, --move or --remove");
  jobs::PreviewResult result;
  {
    TerminalProgress progress(options.common.quiet);
    result = jobs::run_preview(job, {options.common.threads, &cancel_on_signal(), progress.sink()});
  }
  if (options.common.json) {
    print_json(preview_json(result.what_if, result.scene));
  } else if (!options.common.quiet) {
    constexpr std::size_t most = 8;
    fmt::print("{}\n{}", styled(Style::answer, preview_answer(result.what_if)),
               preview_remarks(result.what_if, result.scene));
    print_table(preview_table(result.what_if, result.scene, most), 1);
  }
  if (!result.not_kept.empty() && !options.common.quiet)
    print_message("{} {}\n", styled(Style::warning, "warning:", stderr), one_line(result.not_kept));
  return result.is_stopped ? stopped_early : done;
}

}  // namespace

void add_preview(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("preview", "Preview which labels units at any place would reach");
  auto options = std::make_shared<PreviewArguments>();
  jobs::PreviewJob& job = options->job;
  const OptionGroup first(*verb);
  first.require("STORE", job.store, a_path(), "Store file (JSON)");
  first.add("--from", job.plan, a_path("PLAN"),
            "Folder of a plan, whose units stay instead of those that the store selects; its file "
            "light.operator makes the next preview fast");
  const CLI::Validator text([](std::string&) { return std::string(); }, "UNIT");
  first
      .add("--unit", job.added, text,
           "Add a unit: x,y,z[,ax,ay,az][,type], in metres; straight down by default")
      ->allow_extra_args(false);
  first
      .add("--move", job.moved, text, "Move a unit of the plan, or of the store: ID,x,y,z[,ax,ay,az][,type]")
      ->allow_extra_args(false);
  first.add("--remove", job.removed, an_id(), "Remove a unit of the plan, or of the store")
      ->allow_extra_args(false);
  first.add("--refine", job.refine_s, positive_number("SECONDS"),
            "Simulate the units for SECONDS instead, without bias");
  first.add_flag("--coarse", job.coarse, "Compute the light of the shop in less time, with larger errors");
  add_store_options(*verb, job.allow_outside);
  finish_verb(*verb, chosen, options, run_preview_verb,
              "Examples:\n"
              "  shelfbeam preview store.json\n"
              "  shelfbeam preview store.json --unit 4.2,3.1,2.9\n"
              "  shelfbeam preview store.json --from plan --unit 4.2,3.1,2.9,0,0.5,-1\n"
              "  shelfbeam preview store.json --from plan --move C7,4.2,3.1,2.9 --remove C12\n"
              "  shelfbeam preview store.json --from plan --unit 4.2,3.1,2.9 --refine 10");
}

}  // namespace shelfbeam::app
