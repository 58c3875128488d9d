#include "app/loaded_store.hpp"

#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::app {

LoadedStore load_store(const std::filesystem::path& path, bool allow_outside, std::size_t memory) {
  const Store store = read_store(path, {allow_outside, memory == 0 ? most_of_the_memory() : memory});
  LoadedStore loaded{make_scene(store), {}, {}};
  loaded.resolved = resolved_store_json(store, loaded.scene);
  loaded.hash = content_hash(loaded.resolved);
  return loaded;
}

void add_store_options(CLI::App& verb, bool& allow_outside) {
  verb.add_flag("--allow-outside", allow_outside,
                "Let the store file name files (meshes, tables, profiles) outside its folder");
}

}  // namespace shelfbeam::app
