#include "shelfbeam/scene/read_scene.hpp"

#include <memory>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/mesh/read_cache.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

std::shared_ptr<ReadCache> make_read_cache() {
  return std::make_shared<ReadCache>();
}

Scene read_scene(const std::filesystem::path& store, const StoreLimits& trust) {
  return make_scene(read_store(store, trust));
}

StoreWithScene read_store_with_scene(const std::filesystem::path& path, const StoreLimits& trust) {
  auto store = std::make_shared<const Store>(read_store(path, trust));
  Scene scene = make_scene(*store);
  return {std::move(store), std::move(scene)};
}

void clear_units(Store& store) {
  store.grids.clear();
  store.areas.clear();
  store.rails.clear();
  store.faces.clear();
  store.transceivers.clear();
  store.keep_out.clear();
  store.installed.clear();
  store.pinned.clear();
  store.excluded.clear();
  store.selected.clear();
}

Store store_with_units(Store store, const std::filesystem::path& csv) {
  clear_units(store);
  read_transceivers_csv({InputFile(csv)}, StoreNames(store), store);
  if (store.transceivers.empty()) throw InputError(csv.string(), "lists no units", "list the mounted units");
  return store;
}

}  // namespace shelfbeam
