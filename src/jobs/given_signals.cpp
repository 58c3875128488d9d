#include "jobs/given_signals.hpp"

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"

#include "jobs/plan_folder.hpp"
#include "jobs/plan_record.hpp"

namespace shelfbeam::jobs {

namespace {

void add_light(StoredSignals& signals, const std::filesystem::path& store) {
  if (signals.provenance.store_hash != content_hash(read_file(store))) return;
  const Scene scene = make_scene(read_store(store));
  if (scene.labels.size() == signals.rows() && scene.transceivers.size() == signals.columns())
    detail::set_light(signals, scene);
}

}  // namespace

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

}  // namespace shelfbeam::jobs
