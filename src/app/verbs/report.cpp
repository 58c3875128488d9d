#include "shelfbeam/report/data/report.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "app/files.hpp"
#include "app/options/arguments.hpp"
#include "app/plan_folder.hpp"
#include "app/plan_record.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  std::filesystem::path folder;
  bool safe_csv = false;
};

int run_report(const Options& options) {
  const Scene scene = make_scene(load_store(options.folder / store_name));
  const SignalMatrix matrix = read_signal_file(options.folder / signal_name);
  // The hash is of the bytes that `plan` wrote; this version might write the same store differently.
  if (matrix.provenance.store_hash != content_hash(read_file(options.folder / store_name)))
    throw InputError((options.folder / signal_name).string(),
                     "does not belong to the store file in this folder", "run 'shelfbeam plan' again");
  const SignalTable table = make_signal_table(matrix, (options.folder / signal_name).string());
  const CertifiedPlan plan = read_plan(options.folder / placement_name, table);
  AtomicFolder files(options.folder);
  write_report(files, {scene, matrix, plan, options.safe_csv});
  const std::string placement = read_file(options.folder / placement_name);
  const std::optional<PlanRecord> record = read_record(options.folder / placement_name);
  const std::string recorded = record ? recorded_again(placement, *record, hashes_of(files)) : placement;
  if (recorded == placement) {
    files.commit({});
  } else {  // another version writes other bytes
    files.add(placement_name).write(recorded);
    files.commit({placement_name});
  }
  const std::string report = (options.folder / report_name).string();
  if (options.common.json)
    print_json({{"report", report}});
  else if (!options.common.quiet)
    fmt::print("{}\n", report);
  return done;
}

}  // namespace

void add_report(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("report", "Rebuild report.html, labels.csv and placement.csv of a plan");
  auto options = std::make_shared<Options>();
  add_path(*verb, "DIR", options->folder, "Folder written by 'shelfbeam plan', from a trusted source (HDF5)")
      ->required();
  add_safe_csv(*verb, options->safe_csv);
  add_common_options(*verb, options->common);
  verb->footer("Example:\n  shelfbeam report plan");
  verb->callback([options, &chosen] { chosen = [options] { return run_report(*options); }; });
}

}  // namespace shelfbeam::app
