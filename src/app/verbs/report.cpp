#include "shelfbeam/report/data/report.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "app/options/arguments.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_files.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_job.hpp"
#include "jobs/plan_record.hpp"

namespace shelfbeam::app {

using namespace jobs;

namespace {

struct ReportArguments {
  CommonOptions common;
  std::filesystem::path folder;
  bool safe_csv = false;
};

// The files that this run replaces, and placement.json, must be those of the plan.
FileHashes expect_unchanged(const std::filesystem::path& folder, const PlanRecord& record,
                            const PlanJournal& journal) {
  FileHashes found;
  for (const char* name : {placement_name, labels_name, placement_table_name, mounting_table_name,
                           mounting_drawing_name, report_name}) {
    const std::filesystem::path file = folder / name;
    const auto status = std::filesystem::symlink_status(file);
    if (!std::filesystem::exists(status)) continue;
    if (std::filesystem::is_regular_file(status)) {
      const std::string& hash = found[name] = hash_of(file, name);
      if (record.contains(name, hash) || journal.contains(name, hash)) continue;
    }
    throw InputError(file.string(), "was changed since the plan was written",
                     name == placement_name ? "restore it, or run 'shelfbeam plan' again"
                                            : "move it elsewhere; it will then be rebuilt");
  }
  return found;
}

void replace(const std::filesystem::path& folder, AtomicFolder& files) {
  const std::optional<PlanRecord> record = read_record(folder / placement_name);
  if (!record) return files.commit({});  // a plan of version 0.2.0 or earlier
  const PlanJournal journal(folder);
  FileHashes old = expect_unchanged(folder, *record, journal);
  FileHashes hashes = hashes_of(files);
  const std::string placement = read_file(folder / placement_name);
  const std::string recorded = recorded_again(placement, *record, hashes);
  if (recorded != placement) files.add(placement_name).write(recorded);  // another version writes other bytes
  journal.commit(files, old, hashes, {});
}

int run_report(const ReportArguments& options) {
  std::optional<OutputLock> lock;
  if (std::filesystem::is_directory(options.folder))
    lock.emplace(options.folder / signal_name, options.folder.string());
  const Store store = read_store(options.folder / store_name);
  const Scene scene = make_scene(store);
  const SignalMatrix matrix = read_signal_file(options.folder / signal_name);
  // The hash is of the bytes that `plan` wrote; this version might write the same store differently.
  if (matrix.provenance.store_hash != content_hash(read_file(options.folder / store_name)))
    throw InputError((options.folder / signal_name).string(),
                     "does not belong to the store file in this folder", "run 'shelfbeam plan' again");
  const SignalTable table = make_signal_table(matrix, (options.folder / signal_name).string());
  const CertifiedPlan plan = read_plan(options.folder / placement_name, table);
  AtomicFolder files(options.folder);
  jobs::add_report(files, {scene, matrix, plan, options.safe_csv, shop_states(store, scene, matrix, plan)});
  replace(options.folder, files);
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
      app.add_subcommand("report", "Rebuild the report, the mounting files and the tables of a plan");
  auto options = std::make_shared<ReportArguments>();
  OptionGroup(*verb).require("DIR", options->folder, a_path(),
                             "Folder written by 'shelfbeam plan', from a trusted source (HDF5)");
  add_safe_csv(*verb, options->safe_csv);
  finish_verb(*verb, chosen, options, run_report, "Example:\n  shelfbeam report plan");
}

}  // namespace shelfbeam::app
