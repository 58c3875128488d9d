#include "jobs/plan_files.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

namespace {

// `own`: the folder of this run; null elsewhere, where there are no other files.
void write(const fs::path& folder, const PlanFolder* own, const PlanContents& contents) {
  const auto& [store, scene, resolved, plan, answer, run, safe_csv] = contents;
  const SignalMatrix& matrix = plan.simulation.matrix;
  AtomicFolder files(folder);
  files.add(store_name).write(resolved);
  write_signal_file(matrix, files.add(signal_name));
  if (plan.certificate)
    files.add(verification_name).write(verification_csv(*plan.certificate, scene, safe_csv));
  if (plan.availability && plan.availability->has_answer())
    files.add(verification_name).write(availability_csv(*plan.availability, scene, safe_csv));
  add_report(files, {scene, matrix, plan, safe_csv, shop_states(store, scene, matrix, plan)});
  files.add(run_name).write(run);
  const FileHashes hashes = hashes_of(files);
  files.add(placement_name).write(recorded_placement(answer, plan.complete, hashes));
  if (own != nullptr)
    own->commit(files, hashes);
  else
    files.commit({});
}

}  // namespace

void add_report(AtomicFolder& files, const ReportInput& input) {
  files.add(labels_name).write(labels_csv(input));
  files.add(placement_table_name).write(placement_csv(input));
  files.add(bill_name).write(bill_csv(input));
  files.add(mounting_table_name).write(mounting_csv(input));
  files.add(mounting_drawing_name).write(mounting_dxf(input));
  files.add(report_name).write(report_html(input));
}

std::optional<fs::path> keep_plan_elsewhere(const PlanContents& contents) {
  return keep_elsewhere([&](const fs::path& path) { write(path, nullptr, contents); });
}

void write_plan(const PlanFolder& folder, const fs::path& path, const PlanContents& contents) {
  try {
    write(path, &folder, contents);
  } catch (const OutputError& error) {
    const auto elsewhere = keep_plan_elsewhere(contents);
    std::string kept = elsewhere ? fmt::format("the plan is kept in '{}'", elsewhere->string()) : "";
    const SimulationSummary& summary = contents.plan.simulation.summary;
    if (!summary.has_checkpoint) {
      if (!elsewhere) throw;
      throw OutputError(error, kept, Setting::none);
    }
    if (elsewhere) kept += "; ";
    kept += summary.has_all_in_checkpoint ? checkpoint_remains : older_checkpoint;
    throw OutputError(error, kept, Setting::resumption);
  }
}

}  // namespace shelfbeam::jobs
