#include "jobs/stored_plan.hpp"

#include <string>
#include <utility>
#include <variant>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/question/fitting_signals.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/world/rough_coats.hpp"

#include "jobs/plan_folder.hpp"
#include "jobs/plan_record.hpp"

namespace shelfbeam::jobs {

namespace {

// Programs without light hashes omitted the light that smooth coats of curved meshes reflect first.
void add_light(StoredSignals& signals, const std::filesystem::path& store) {
  if (signals.provenance.store_hash != hash_of_resolved(read_file(store))) return;
  const Scene scene = make_scene(read_store(store));
  if (with_rough_coats(scene)) return;
  if (scene.labels.size() == signals.rows() && scene.transceivers.size() == signals.columns())
    detail::set_light(signals, scene);
}

}  // namespace

StoredPlan read_stored_plan(const std::filesystem::path& folder) {
  Store store = read_store(folder / store_name);
  Scene scene = make_scene(store);
  const std::string signal = (folder / signal_name).string();
  SignalMatrix matrix = read_signal_file(signal);
  // The hash is of the bytes that `plan` wrote; this version might write the same store differently.
  if (matrix.provenance.store_hash != hash_of_resolved(read_file(folder / store_name)))
    throw InputError(signal, "does not belong to the store file in this folder", "plan the store again");
  SignalTable table = table_without_signals(scene);
  table.mounts = shared_mounts(matrix);
  CertifiedPlan plan = read_plan(folder / placement_name, table);
  return {std::move(store), std::move(scene), std::move(matrix), std::move(plan)};
}

StoredSignals read_given_signals(const std::filesystem::path& signals) {
  if (!std::filesystem::is_directory(signals)) return read_signal_file(signals);
  StoredSignals found = read_signal_file(signals / signal_name);
  if (found.provenance.light_hash) return found;
  add_light(found, signals / store_name);
  // Nor did these versions mark the signals of an interrupted simulation.
  const std::filesystem::path placement = signals / placement_name;
  if (std::filesystem::exists(placement))
    if (const auto record = read_record(placement)) found.provenance.complete = record->is_complete;
  return found;
}

bool has_fitting_signals(const std::filesystem::path& folder, const Scene& scene, const PathRules& wanted) {
  if (!std::filesystem::exists(folder / placement_name)) return false;
  try {
    return std::holds_alternative<SignalMatrix>(fitting_signals(read_given_signals(folder), scene, wanted));
  } catch (const InputError&) {  // not of a plan
    return false;
  }
}

}  // namespace shelfbeam::jobs
