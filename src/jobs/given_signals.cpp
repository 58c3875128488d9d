#include "jobs/given_signals.hpp"

#include <cstddef>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "jobs/plan_folder.hpp"

namespace shelfbeam::jobs {

namespace {

void add_light(StoredSignals& signals, const std::filesystem::path& store) {
  if (signals.provenance.store_hash != content_hash(read_file(store))) return;
  const Scene scene = make_scene(read_store(store));
  const LightKeys keys = light_keys(scene);
  if (keys.labels.size() != signals.rows() || keys.transceivers.size() != signals.columns()) return;
  signals.provenance.light_hash = keys.light_hash;
  for (std::size_t i = 0; i < signals.rows(); ++i) signals.labels[i].light = keys.labels[i];
  for (std::size_t j = 0; j < signals.columns(); ++j) signals.transceivers[j].light = keys.transceivers[j];
}

}  // namespace

StoredSignals read_given_signals(const std::filesystem::path& signals) {
  if (!std::filesystem::is_directory(signals)) return read_signal_file(signals);
  StoredSignals found = read_signal_file(signals / signal_name);
  if (found.provenance.light_hash.empty()) add_light(found, signals / store_name);
  return found;
}

}  // namespace shelfbeam::jobs
