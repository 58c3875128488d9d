#include "app/batch/own_files.hpp"

#include <optional>
#include <system_error>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "jobs/file_journal.hpp"

namespace shelfbeam::app {

using namespace jobs;
namespace fs = std::filesystem;

namespace {

// The hash of a missing file is that of an empty one. Nothing for folders, links and other entries.
std::optional<std::string> present_hash(const fs::path& file) {
  std::error_code unknown;
  const fs::file_status status = fs::symlink_status(file, unknown);
  if (status.type() == fs::file_type::not_found) return content_hash("");
  if (!fs::is_regular_file(status)) return std::nullopt;
  return content_hash(read_file(file));
}

// The reason for which a file must not be replaced; empty if it may be.
std::string problem_of(const FileJournal& journal, const std::string& name,
                       const std::optional<std::string>& hash) {
  if (hash && (*hash == content_hash("") || journal.contains(name, *hash))) return {};
  return hash && journal.contains(name) ? "was changed since a batch wrote it" : "was not written by a batch";
}

}  // namespace

void expect_own_files(const fs::path& folder, const std::vector<std::string>& names, bool overwrite) {
  const FileJournal journal(folder, journal_name);
  FileHashes accepted;
  for (const std::string& name : names) {
    const auto hash = present_hash(folder / name);
    const std::string problem = problem_of(journal, name, hash);
    if (problem.empty()) continue;
    const bool is_edited = hash && journal.contains(name);
    if (!is_edited)
      throw InputError((folder / name).string(), problem, "choose another folder for the results");
    if (!overwrite)
      throw InputError((folder / name).string(), problem,
                       "move it to another place, or allow it to be replaced", Setting::overwriting);
    accepted[name] = *hash;
  }
  if (!accepted.empty()) journal.write({accepted});
}

void replace_own_files(const fs::path& folder, const std::map<std::string, std::string>& contents) {
  const FileJournal journal(folder, journal_name);
  AtomicFolder files((folder / contents.begin()->first).parent_path());
  FileHashes older, newer;
  for (const auto& [name, content] : contents) {
    const fs::path file = folder / name;
    const auto hash = present_hash(file);
    if (const std::string problem = problem_of(journal, name, hash); !problem.empty())
      throw OutputError(file.string(), problem, "move it to another place");
    older[name] = *hash;
    newer[name] = content_hash(content);
    files.add(file.filename()).write(content);
  }
  journal.write({older, newer});
  files.commit({});
  journal.write({newer});
}

}  // namespace shelfbeam::app
