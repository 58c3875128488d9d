#include "app/plan_folder.hpp"

#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

namespace shelfbeam::app {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Hashes = std::map<std::string, std::string>;

constexpr std::array names{store_name,           signal_name, verification_name, labels_name,
                           placement_table_name, report_name, placement_name};
constexpr std::string_view record_begin = ",\n  \"complete\": ";

// Two runs with the same result differ in these numbers only.
std::string without_times(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t begin = std::string_view::npos;
    for (const std::string_view mark : {"\"seconds\": ", "<dt>Time</dt><dd>"})
      if (const auto found = text.find(mark); found < begin) begin = found + mark.size();
    result += text.substr(0, begin);
    text.remove_prefix(std::min(begin, text.size()));
    text.remove_prefix(std::min(text.find_first_of(",\n<"), text.size()));
  }
  return result;
}

// placement.json is hashed without the hashes that it contains.
std::string hash_of(const fs::path& file, const std::string& name) {
  if (name == signal_name) {
    std::ifstream content(file, std::ios::binary);
    return content_hash(content);
  }
  const std::string text = read_file(file);
  if (name == placement_name) return content_hash(without_times(text.substr(0, text.find(record_begin))));
  return content_hash(name == report_name ? without_times(text) : text);
}

std::string with_record(const std::string& answer, bool is_complete, const Hashes& hashes) {
  // The answer ends with "\n}\n".
  std::string text = answer.substr(0, answer.size() - 3);
  text += fmt::format("{}{},\n  \"files\": {{", record_begin, is_complete);
  const char* separator = "\n";
  for (const auto& [name, hash] : hashes) {
    text += fmt::format("{}    \"{}\": \"{}\"", separator, name, hash);
    separator = ",\n";
  }
  return text + "\n  }\n}\n";
}

/// What placement.json says about the plan in its folder.
struct Record {
  bool is_plan = false;  ///< any version
  bool is_complete = true;
  std::optional<Hashes> hashes;  ///< nothing for plans of version 0.2.0 and earlier

  explicit Record(const fs::path& file) {
    const Json json = Json::parse(read_file(file), nullptr, false);
    is_plan = json.is_object() && json.contains("format") && json.contains("selected");
    if (!is_plan || !json.contains("complete") || !json.contains("files")) return;
    is_complete = json["complete"] != false;
    hashes.emplace();
    for (const auto& [name, hash] : json["files"].items())
      if (hash.is_string()) hashes->emplace(name, hash.get<std::string>());
  }
};

bool begins_with(const fs::path& file, std::string_view head) {
  std::string found(head.size(), '\0');
  std::ifstream(file, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == head;
}

// For plans without hashes: those of earlier versions, and those whose run was killed while it renamed files.
bool looks_like_ours(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  if (name == labels_name) return begins_with(file, "id,x,y,z,nx,ny,nz,type,requirement,signal,");
  if (name == placement_table_name)
    return begins_with(file, "id,x,y,z,ax,ay,az,roll_deg,type,cost,installed,");
  if (name == verification_name) return begins_with(file, "id,verdict,requirement,signal,");
  if (name == report_name) return read_file(file).find("shelfbeam ") != std::string::npos;
  if (name == signal_name)  // `simulate` writes the same file, but no store
    return fs::exists(folder / store_name) && is_hdf5(file);
  const fs::path signal = folder / signal_name;
  return fs::exists(signal) && is_hdf5(signal) &&
         read_signal_file(signal).provenance.store_hash == content_hash(read_file(file));
}

bool is_ours(const fs::path& folder, const std::string& name, const std::optional<Record>& record,
             const std::string& store) {
  const fs::path file = folder / name;
  if (!fs::is_regular_file(file)) return false;
  if (name == store_name && read_file(file) == store) return true;
  if (record && record->hashes) {
    const auto known = record->hashes->find(name);
    return known != record->hashes->end() && known->second == hash_of(file, name);
  }
  return name == placement_name ? record && record->is_plan : looks_like_ours(folder, name);
}

}  // namespace

std::string recorded_placement(const std::string& answer, bool is_complete, const AtomicFolder& files) {
  Hashes hashes{{placement_name, content_hash(without_times(answer.substr(0, answer.size() - 3)))}};
  for (const AtomicFile& file : files.files()) {
    const std::string name = file.target().filename().string();
    hashes[name] = hash_of(file.temporary(), name);
  }
  return with_record(answer, is_complete, hashes);
}

std::string recorded_again(const std::string& placement, const AtomicFolder& files) {
  const auto end = placement.find(record_begin);
  if (end == std::string::npos) return placement;
  Json json = Json::parse(placement);
  Hashes hashes = json["files"].get<Hashes>();
  for (const AtomicFile& file : files.files()) {
    const std::string name = file.target().filename().string();
    hashes[name] = hash_of(file.temporary(), name);
  }
  return with_record(placement.substr(0, end) + "\n}\n", json["complete"] != false, hashes);
}

PlanFolder::Made::Made(fs::path folder) : path(std::move(folder)), is_new(!fs::exists(path)) {
  make_output_folder(path);
}

PlanFolder::Made::~Made() {
  std::error_code not_empty;
  if (is_new) fs::remove(path, not_empty);
}

PlanFolder::PlanFolder(fs::path folder, const std::string& store, bool overwrite)
    : folder_(std::move(folder)), lock_(folder_.path / signal_name, folder_.path.string()) {
  const fs::path& path = folder_.path;
  std::optional<Record> record;
  if (fs::is_regular_file(path / placement_name)) record.emplace(path / placement_name);
  has_finished_plan_ = record && record->is_plan && record->is_complete;
  if (has_finished_plan_ && !overwrite)
    throw InputError(path.string(), "contains a finished plan, which is not replaced",
                     "choose another folder, or allow to replace the plan", Setting::overwriting);
  for (const char* name : names)
    if (fs::exists(path / name) && !is_ours(path, name, record, store))
      throw InputError((path / name).string(),
                       "was not written by an earlier plan in this folder, or was changed since",
                       "move it to another place, or choose another folder for the plan");
  for (const char* name : names) const AtomicFile probe(path / name);
}

PlanFolder::~PlanFolder() = default;

}  // namespace shelfbeam::app
