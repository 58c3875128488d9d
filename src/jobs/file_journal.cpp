#include "jobs/file_journal.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

FileJournal::FileJournal(const fs::path& folder, const char* name) : file_(folder / name) {
  const fs::file_status status = fs::symlink_status(file_);
  if (!fs::exists(status)) return;
  constexpr std::uint64_t most = 1 << 16;
  std::istringstream text(fs::is_regular_file(status) ? read_file(file_, most) : "");
  for (std::string file, hash; text >> file >> hash;) files_.emplace(file, hash);
  const auto is_foreign = [](const auto& entry) { return entry.second.size() != content_hash("").size(); };
  if (files_.empty() || std::any_of(files_.begin(), files_.end(), is_foreign))
    throw InputError(file_.string(), "was not written by an earlier run in this folder", "move it elsewhere");
}

bool FileJournal::contains(const std::string& name) const {
  const auto found = files_.lower_bound({name, ""});
  return found != files_.end() && found->first == name;
}

void FileJournal::write(const std::vector<FileHashes>& hashes) const {
  std::string text;
  for (const FileHashes& list : hashes)
    for (const auto& [name, hash] : list) text += fmt::format("{} {}\n", name, hash);
  for (const auto& entry : files_) {
    const auto is_new = [&](const FileHashes& list) { return list.contains(entry.first); };
    if (std::none_of(hashes.begin(), hashes.end(), is_new))
      text += fmt::format("{} {}\n", entry.first, entry.second);
  }
  write_file(file_, text);
}

}  // namespace shelfbeam::jobs
