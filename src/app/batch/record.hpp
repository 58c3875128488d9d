#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "shelfbeam/report/batch/store_result.hpp"

#include "app/batch/child.hpp"
#include "app/batch/store_list.hpp"

namespace shelfbeam::app {

/// The folder with the results of a batch (docs/formats/batch.md).
struct BatchFolder {
  std::filesystem::path path;

  std::filesystem::path plan(const std::string& name) const { return path / "plans" / name; }
  std::filesystem::path record(const std::string& name) const { return path / "records" / (name + ".json"); }
};

/// A result with a key of all that determines it: the bytes of the store file, the options of `plan` and the
/// version of the program.
struct StoreRecord {
  StoreResult result;
  std::string input;
  bool is_final = false;  ///< the plan was not interrupted
};

/// Reads the record of a store; nothing if there is none. Throws InputError for a file that is not a record.
std::optional<StoreRecord> read_record(const BatchFolder& folder, const ListedStore& store);

/// Throws OutputError.
void write_record(const BatchFolder& folder, const StoreRecord& record);

/// The result of a store that is not planned yet.
StoreResult without_result(const ListedStore& store);

/// The result of a plan that has ended, from its exit code, its output and its folder.
StoreResult result_of(const BatchFolder& folder, const ListedStore& store, const ChildEnd& end);

}  // namespace shelfbeam::app
