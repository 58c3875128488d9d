#include "shelfbeam/scene/build/installation.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/store/device_csv.hpp"
#include "shelfbeam/scene/store/store_names.hpp"

namespace shelfbeam {

Scene scene_with_units(Store store, const std::filesystem::path& csv) {
  store.grids.clear();
  store.transceivers.clear();
  store.keep_out.clear();
  store.installed.clear();
  read_transceivers_csv(csv, StoreNames(store), store);
  if (store.transceivers.empty())
    throw InputError(csv.string(), "names no units", "list the units that hang");
  return make_scene(store);
}

}  // namespace shelfbeam
