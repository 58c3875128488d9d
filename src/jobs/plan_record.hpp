#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/file.hpp"

#include "jobs/file_journal.hpp"

namespace shelfbeam::jobs {

/// The end of placement.json in the folder of a plan, by which a later run recognises the plan's files.
struct PlanRecord {
  bool is_complete = true;  ///< the run was not interrupted
  FileHashes hashes;
  bool omits_times = false;  ///< of format 1: the hashes of placement.json and the report are of other bytes

  /// Whether it names a file with this hash. A record of format 1 names placement.json and the report with
  /// any contents.
  bool contains(const std::string& name, const std::string& hash) const;
  /// The text of placement.json from "complete" on.
  std::string text() const;
};

/// The record in a placement.json; nothing if it has none (a plan of version 0.2.0 or earlier, or of
/// `place`). Throws InputError for a file that is not JSON, and for an invalid record.
std::optional<PlanRecord> read_record(const std::filesystem::path& placement);

/// The contents of placement.json: `answer` is the object without a record, `files` are all others.
std::string recorded_placement(const std::string& answer, bool is_complete, const FileHashes& files);

/// The contents of placement.json without its record, as of `answer` above.
std::string without_record(const std::string& placement, const PlanRecord& record);

/// The contents of placement.json with the hashes of files that were written again.
std::string recorded_again(const std::string& placement, PlanRecord record, const FileHashes& files);

/// The hash of a file with a name of a plan; without the record of placement.json.
std::string hash_of(const std::filesystem::path& file, std::string_view name);

/// The hashes of new files that are not yet in their folder, except run.json.
FileHashes hashes_of(const AtomicFolder& files);

/// The files that a run was about to replace, and those by which it replaced them. They remain in a hidden
/// file of the folder if the run is killed, so that the next run recognises both.
class PlanJournal : public FileJournal {
 public:
  /// Reads the journal of a killed run, if there is one. Throws InputError for any other file of its name.
  explicit PlanJournal(const std::filesystem::path& folder);

  /// Commits the files of the folder under the protection of a journal. Throws OutputError.
  void commit(AtomicFolder& files, const FileHashes& older, const FileHashes& newer,
              const std::vector<std::string>& outdated) const;
};

}  // namespace shelfbeam::jobs
