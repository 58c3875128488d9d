#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "shelfbeam/report/batch/store_result.hpp"

#include "app/batch/store_list.hpp"
#include "jobs/child.hpp"
#include "jobs/event.hpp"

namespace shelfbeam::app {

inline constexpr auto records_name = "records";

/// The folder with the results of a batch (docs/formats/batch.md).
struct BatchFolder {
  std::filesystem::path path;

  std::filesystem::path plan(const std::string& name) const { return path / "plans" / folder_of_name(name); }
  std::filesystem::path record(const std::string& name) const {
    return path / records_name / file_of_name(name, ".json");
  }
};

/// A result with a key of all that determines it: the bytes of the store file, the options of `plan` and the
/// version of the program.
struct StoreRecord {
  StoreResult result;
  std::string input;
  bool is_final = false;    ///< the plan has ended with an answer
  std::string damage = {};  ///< the reason why the file says nothing about its store; empty for a good record
};

/// Reads the record of a store; nothing if there is none. A file that is damaged, or is the record of another
/// store, counts as one without an input, whose store failed. Throws InputError for the format of a later
/// version.
std::optional<StoreRecord> read_record(const BatchFolder& folder, const ListedStore& store);

/// Throws OutputError.
void write_record(const BatchFolder& folder, const StoreRecord& record);

/// The result of a store that is not planned yet.
StoreResult without_result(const ListedStore& store);
/// The result of a store without a plan, for a reason.
StoreResult failed_result(const ListedStore& store, const std::string& reason);

/// The effort of a plan with that of another run.
PlanEffort with_run(PlanEffort effort, const jobs::ChildEnd& end);

/// The result of a plan whose job has ended.
StoreResult result_of(const BatchFolder& folder, const ListedStore& store, const jobs::JobEnd& end);

}  // namespace shelfbeam::app
