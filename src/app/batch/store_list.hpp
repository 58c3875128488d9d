#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// A store of a batch.
struct ListedStore {
  std::string name;            ///< unique, UTF-8 without control characters; a relative path without ".."
  std::filesystem::path file;  ///< the store file, which need not exist
};

/// The stores of a batch, and remarks about their source.
struct StoreList {
  std::vector<ListedStore> stores;  ///< sorted by name
  std::vector<std::string> remarks;
};

/// The stores of a batch. `source` is a text file with one path per line, relative to its folder; empty lines
/// and lines that begin with # are ignored, and a path may be in double quotes and have backslashes as
/// separators. Or it is a folder: its stores are all files called store.json below it, or, if there are none,
/// all .json files in it. Folders of plans and batches, and `results`, are omitted. Links to folders are not
/// followed, except to find the store.json in the folder to which they lead. A folder that cannot be read is
/// listed as a store that cannot be read.
///
/// A store is called by its path without "store.json" or ".json"; the second of two equal names ends with
/// "~2". Throws InputError if the source cannot be read, or names no store.
StoreList listed_stores(const std::filesystem::path& source, const std::filesystem::path& results);

/// The path of a store's folder in a folder of folders; its steps are not too long for a file system.
std::filesystem::path folder_of_name(const std::string& name);

/// The path of a store's file in a folder of such files. Its steps are not too long, and no name needs a file
/// where another needs a folder.
std::filesystem::path file_of_name(const std::string& name, const std::string& extension);

}  // namespace shelfbeam::app
