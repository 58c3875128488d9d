#include "jobs/plan_folder.hpp"

#include <exception>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "jobs/run_file.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

namespace {

constexpr auto finished_plan = "contains a finished plan, which is not replaced";
constexpr auto finished_plan_since = "has received a finished plan since the run started; it is not replaced";
constexpr auto foreign_file = "was not written by an earlier run in this folder, or was changed since";
// Plans of version 0.2.0 and earlier have no record. `place` writes such a file, too, but without the others.
bool is_old_plan(const fs::path& folder) {
  try {
    const JsonCursor json = JsonCursor::parse_file(folder / placement_name);
    return json.find("format") && json.find("selected") &&
           read_signal_file(folder / signal_name).provenance.store_hash ==
               hash_of_resolved(read_file(folder / store_name));
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

// The files of a plan's names.
struct PlanFolder::Found {
  bool has_finished_plan = false;
  FileHashes hashes;
  std::optional<std::string> foreign;  ///< the first that no earlier run wrote
};

PlanFolder::Found PlanFolder::look() const {
  const fs::path& folder = folder_.path;
  Found found;
  std::optional<PlanRecord> record;
  bool is_plan = false;
  if (fs::is_regular_file(fs::symlink_status(folder / placement_name))) {
    input_size(folder / placement_name, max_text_file);
    try {
      record = read_record(folder / placement_name);
      is_plan = record || is_old_plan(folder);
    } catch (const InputError&) {  // not of a plan
    }
  }
  found.has_finished_plan = is_plan && (!record || record->is_complete);
  const PlanJournal journal(folder);
  const auto is_ours = [&](const std::string& name) {
    const fs::path file = folder / name;
    // A link to a file of a plan is not a file of a plan.
    if (!fs::is_regular_file(fs::symlink_status(file)) || (name == placement_name && !is_plan)) return false;
    if (name == run_name) return is_run_file(file);
    const bool is_old = is_plan && !record;
    const bool is_recorded = record && record->hashes.contains(name);
    // Other files of the user may be large, and are not read.
    if (!is_old && !is_recorded && !journal.contains(name) && name != store_name) return false;
    const std::string& hash = found.hashes[name] = hash_of(file, name);
    return is_old || (is_recorded && record->contains(name, hash)) || journal.contains(name, hash) ||
           (name == store_name && hash_of_resolved(read_file(file)) == hash_of_resolved(store_));
  };
  for (const char* name : plan_file_names)
    if (!found.foreign && fs::exists(fs::symlink_status(folder / name)) && !is_ours(name))
      found.foreign = name;
  return found;
}

PlanFolder::Made::Made(fs::path folder) : path(std::move(folder)) {
  std::error_code unknown;
  for (fs::path level = path; !level.empty() && !fs::exists(level, unknown) && !unknown;
       level = level.parent_path())
    levels.push_back(level);
  try {
    make_output_folder(path);
  } catch (const OutputError&) {
    remove();
    throw;
  }
}

void PlanFolder::Made::remove() const {
  std::error_code reason;
  for (const fs::path& level : levels)
    if (!fs::remove(level, reason) && fs::exists(level, reason)) break;
}

PlanFolder::PlanFolder(fs::path folder, std::string store, bool overwrite,
                       const std::function<bool()>& can_reuse)
    : folder_(std::move(folder)),
      store_(std::move(store)),
      overwrite_(overwrite),
      lock_(folder_.path / signal_name, folder_.path.string()) {
  const fs::path& path = folder_.path;
  const Found found = look();
  has_finished_plan_ = found.has_finished_plan;
  if (has_finished_plan_ && !overwrite_) {
    constexpr auto remedy = "choose another folder, or allow the plan to be replaced";
    if (!can_reuse()) throw InputError(path.string(), finished_plan, remedy, Setting::overwriting);
    throw InputError(path.string(), finished_plan,
                     fmt::format("{}; its signals fit this store and can be reused", remedy),
                     Setting::overwriting_with_reuse);
  }
  if (found.foreign)
    throw InputError((path / *found.foreign).string(), foreign_file,
                     "move it to another place, or choose another folder for the plan");
  for (const char* name : plan_file_names) const AtomicFile probe(path / name);
}

void PlanFolder::commit(AtomicFolder& files, const FileHashes& hashes) const {
  // The work may have taken hours, in which the user may have opened, edited or added files.
  const fs::path& path = folder_.path;
  Found found;
  try {
    found = look();
  } catch (const std::exception& unreadable) {
    throw OutputError("", unreadable.what());
  }
  if (found.has_finished_plan && (!overwrite_ || !has_finished_plan_))
    throw OutputError(path.string(), finished_plan_since);
  if (found.foreign) throw OutputError((path / *found.foreign).string(), foreign_file);
  PlanJournal(path).commit(files, found.hashes, hashes, {placement_name, verification_name});
}

PlanFolder::~PlanFolder() = default;

}  // namespace shelfbeam::jobs
