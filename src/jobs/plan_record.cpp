#include "jobs/plan_record.hpp"

#include <fstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "jobs/plan_folder.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

namespace {

// Named like a temporary file, though not like one of a file of the plan, which the next run would remove.
constexpr auto journal_name = ".plan.shelfbeam-record";

// In earlier formats, placement.json and the report contained times, which their hashes omitted.
constexpr double first_stable_format = 2;

// The answer ends with it.
constexpr std::string_view answer_end = "\n}\n";

}  // namespace

std::string PlanRecord::text() const {
  std::string text = fmt::format(",\n  \"complete\": {},\n  \"files\": {{", is_complete);
  const char* separator = "\n";
  for (const auto& [name, hash] : hashes) {
    text += fmt::format("{}    \"{}\": \"{}\"", separator, name, hash);
    separator = ",\n";
  }
  return text + "\n  }\n}\n";
}

bool PlanRecord::contains(const std::string& name, const std::string& hash) const {
  const auto found = hashes.find(name);
  if (found == hashes.end()) return false;
  return found->second == hash || (omits_times && (name == placement_name || name == report_name));
}

std::optional<PlanRecord> read_record(const fs::path& placement) {
  const JsonCursor json = JsonCursor::parse_file(placement);
  if (!json.find("complete") && !json.find("files")) return std::nullopt;
  PlanRecord record{json["complete"].boolean(), {}, json["format"].number() < first_stable_format};
  for (const auto& [name, hash] : json["files"].members()) record.hashes[name] = hash.text();
  return record;
}

std::string recorded_placement(const std::string& answer, bool is_complete, const FileHashes& files) {
  const std::string_view begin = std::string_view(answer).substr(0, answer.size() - answer_end.size());
  PlanRecord record{is_complete, files};
  record.hashes[placement_name] = content_hash(begin);
  return std::string(begin) + record.text();
}

std::string without_record(const std::string& placement, const PlanRecord& record) {
  return placement.substr(0, placement.size() - record.text().size()).append(answer_end);
}

std::string recorded_again(const std::string& placement, PlanRecord record, const FileHashes& files) {
  const std::string old = record.text();
  if (!placement.ends_with(old)) return placement;
  for (const auto& [name, hash] : files) record.hashes[name] = hash;
  return placement.substr(0, placement.size() - old.size()) + record.text();
}

std::string hash_of(const fs::path& file, std::string_view name) {
  if (name == signal_name) {
    input_size(file, memory_limit());
    std::ifstream content(file, std::ios::binary);
    return content_hash(content);
  }
  std::string text = read_file(file);
  if (name == placement_name) {
    const std::optional<PlanRecord> record = read_record(file);
    const std::string end = record ? record->text() : "";
    // Otherwise the record was changed: the whole file has another hash than its part.
    if (text.ends_with(end)) text.resize(text.size() - end.size());
  }
  return content_hash(text);
}

FileHashes hashes_of(const AtomicFolder& files) {
  FileHashes hashes;
  for (const AtomicFile& file : files.files()) {
    const std::string name = file.target().filename().string();
    if (name != run_name) hashes[name] = hash_of(file.temporary(), name);
  }
  return hashes;
}

PlanJournal::PlanJournal(const fs::path& folder) : FileJournal(folder, journal_name) {}

void PlanJournal::commit(AtomicFolder& files, const FileHashes& older, const FileHashes& newer,
                         const std::vector<std::string>& outdated) const {
  const fs::path placement = file().parent_path() / placement_name;
  try {
    write({older, newer});
  } catch (const OutputError& error) {
    if (older.empty()) throw;
    throw OutputError(error, "the older files of the plan are unchanged", Setting::none);
  }
  std::error_code none;
  try {
    files.commit(outdated);
  } catch (...) {
    // Without placement.json, the old files were not all restored.
    if (!older.contains(placement_name) || fs::exists(placement, none)) fs::remove(file(), none);
    throw;
  }
  fs::remove(file(), none);
}

}  // namespace shelfbeam::jobs
