#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "app/options/arguments.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/report_job.hpp"

namespace shelfbeam::app {

namespace {

struct ReportArguments {
  CommonOptions common;
  std::filesystem::path folder;
  std::optional<std::filesystem::path> store;
  bool safe_csv = false;
};

int run_report(const ReportArguments& options) {
  const std::string report = jobs::rebuild_report(options.folder, options.safe_csv, options.store).string();
  if (options.common.json)
    print_json({{"report", report}});
  else if (!options.common.quiet)
    fmt::print("{}\n", report);
  return jobs::done;
}

}  // namespace

void add_report(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("report", "Rebuild the report, the mounting files and the tables of a plan");
  auto options = std::make_shared<ReportArguments>();
  const OptionGroup first(*verb);
  first.require("DIR", options->folder, a_path(),
                "Folder written by 'shelfbeam plan', from a trusted source (HDF5)");
  first.add(
      "--store", options->store, a_path(),
      "Store file whose confirmed values count as confirmed in the report; default: the file from which "
      "the plan was made");
  add_safe_csv(*verb, options->safe_csv);
  finish_verb(*verb, chosen, options, run_report,
              "Examples:\n  shelfbeam report plan\n  shelfbeam report plan --store store.json");
}

}  // namespace shelfbeam::app
