#include "jobs/report_job.hpp"

#include <optional>
#include <string>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/scene/read_scene.hpp"

#include "jobs/plan_files.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_record.hpp"
#include "jobs/plan_values.hpp"
#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {

namespace {

// The files that this run replaces, and placement.json, must be those of the plan.
FileHashes expect_unchanged(const std::filesystem::path& folder, const PlanRecord& record,
                            const PlanJournal& journal) {
  FileHashes found;
  for (const char* name : {placement_name, labels_name, placement_table_name, bill_name, mounting_table_name,
                           mounting_drawing_name, report_name}) {
    const std::filesystem::path file = folder / name;
    const auto status = std::filesystem::symlink_status(file);
    if (!std::filesystem::exists(status)) continue;
    if (std::filesystem::is_regular_file(status)) {
      const std::string& hash = found[name] = hash_of(file, name);
      if (record.contains(name, hash) || journal.contains(name, hash)) continue;
    }
    throw InputError(file.string(), "was changed since the plan was written",
                     name == placement_name ? "restore it, or plan the store again"
                                            : "move it elsewhere; it will then be rebuilt");
  }
  return found;
}

// `plan`: whose values have other states than in placement.json; null if they have the same.
void replace(const std::filesystem::path& folder, AtomicFolder& files, const CertifiedPlan* plan) {
  const std::optional<PlanRecord> record = read_record(folder / placement_name);
  if (!record) return files.commit({});  // a plan of version 0.2.0 or earlier
  const PlanJournal journal(folder);
  FileHashes old = expect_unchanged(folder, *record, journal);
  FileHashes hashes = hashes_of(files);
  const std::string placement = read_file(folder / placement_name);
  std::string recorded = recorded_again(placement, *record, hashes);
  if (plan != nullptr && placement.ends_with(record->text())) {
    FileHashes all = record->hashes;
    for (const auto& [name, hash] : hashes) all[name] = hash;
    recorded =
        recorded_placement(with_values(without_record(placement, *record), *plan), record->is_complete, all);
  }
  if (recorded != placement) files.add(placement_name).write(recorded);  // another version writes other bytes
  journal.commit(files, old, hashes, {});
}

// Whether the states of its values were renewed.
bool renewed(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& store_file,
             StoredPlan& stored) {
  const auto own = store_of_plan(folder);
  if (store_file) return renew_values(stored, read_scene(*store_file), !own);
  // The folder may have come from elsewhere: another shop may lie there now.
  if (!own || own->empty() || std::filesystem::path(*own).is_absolute()) return false;
  try {
    const Scene now = read_scene(folder / *own);
    return now.store_hash == stored.scene.store_hash && renew_values(stored, now, false);
  } catch (const InputError&) {  // it is gone, or is being changed; the plan keeps the states that it has
    return false;
  }
}

}  // namespace

std::filesystem::path rebuild_report(const std::filesystem::path& folder, bool safe_csv,
                                     const std::optional<std::filesystem::path>& store_file) {
  std::optional<OutputLock> lock;
  if (std::filesystem::is_directory(folder)) lock.emplace(folder / signal_name, folder.string());
  StoredPlan stored = read_stored_plan(folder);
  const bool is_renewed = renewed(folder, store_file, stored);
  const auto& [store, scene, matrix, plan] = stored;
  AtomicFolder files(folder);
  add_report(files, {scene, matrix, plan, safe_csv, shop_states(store, scene, matrix, plan)});
  replace(folder, files, is_renewed ? &plan : nullptr);
  return folder / report_name;
}

}  // namespace shelfbeam::jobs
