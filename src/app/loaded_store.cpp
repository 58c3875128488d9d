#include "loaded_store.hpp"

#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::app {

Store load_store(const std::filesystem::path& path, bool allow_outside, std::size_t memory) {
  return read_store(path, {allow_outside, memory == 0 ? most_of_the_memory() : memory});
}

void add_store_options(CLI::App& verb, bool& allow_outside) {
  verb.add_flag("--allow-outside", allow_outside,
                "Let the store file name files (meshes, tables, profiles) outside its folder");
}

}  // namespace shelfbeam::app
