#include "loaded_store.hpp"

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/store.hpp"

namespace shelfbeam::app {

LoadedStore load_store(const std::filesystem::path& path) {
  const Store store = read_store(path);
  LoadedStore loaded{make_scene(store), {}, {}};
  loaded.resolved = resolved_store_json(store, loaded.scene);
  loaded.hash = content_hash(loaded.resolved);
  return loaded;
}

}  // namespace shelfbeam::app
