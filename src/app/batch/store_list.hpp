#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// A store of a batch.
struct ListedStore {
  std::string name;            ///< unique; its path without "store.json" or ".json"
  std::filesystem::path file;  ///< the store file
};

/// The stores of a batch, by their names. `source` is a text file with one path per line, relative to its
/// folder; empty lines and lines that begin with # are ignored. Or it is a folder: its stores are all files
/// called store.json below it, or, if there are none, all .json files in it. Folders of plans and `results`
/// are left out. Throws InputError without any store, for unreadable sources and duplicate names.
std::vector<ListedStore> listed_stores(const std::filesystem::path& source,
                                       const std::filesystem::path& results);

}  // namespace shelfbeam::app
