#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace shelfbeam::jobs {

/// Hashes of files, by their names.
using FileHashes = std::map<std::string, std::string>;

/// A hidden file in a folder with the hashes of other files there, by which a later run recognises those that
/// the program wrote. A file may have several hashes.
class FileJournal {
 public:
  /// Reads the journal, if there is one. Throws InputError for any other file of its name.
  FileJournal(const std::filesystem::path& folder, const char* name);

  const std::filesystem::path& file() const { return file_; }
  bool is_empty() const { return files_.empty(); }
  bool contains(const std::string& name) const;
  bool contains(const std::string& name, const std::string& hash) const {
    return files_.contains({name, hash});
  }

  /// Replaces the entries of these files by new ones. Throws OutputError.
  void write(const std::vector<FileHashes>& hashes) const;

 private:
  std::filesystem::path file_;
  std::set<std::pair<std::string, std::string>> files_;
};

}  // namespace shelfbeam::jobs
