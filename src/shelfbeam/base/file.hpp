#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// The whole file as text. Throws InputError when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// A file that appears under its name only when it is complete: write to `temporary()`, then `commit()`.
/// Without a commit the temporary file is removed and an older file of that name stays as it was.
///
/// Temporary files are called `.NAME.shelfbeam-XXXXXX` and are locked while their writer lives, so the next
/// writer of that name knows, and removes, what a killed one left.
class AtomicFile {
 public:
  /// Throws OutputError when the folder does not exist or cannot be written to.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Writes all of the file. Throws OutputError.
  void write(std::string_view content);
  /// Brings the content to the disk, so that renaming is all that is left. Throws OutputError.
  void flush();
  /// Flushes and renames. Throws OutputError when that fails.
  void commit();

 private:
  friend class AtomicFolder;
  bool rename();

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;  ///< holds the lock
  bool committed_ = false;
};

/// Removes the temporary files of that name whose writers have been killed.
void remove_abandoned(const std::filesystem::path& target);

/// Writes `content` to `path` through an AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Files of one folder that belong together.
class AtomicFolder {
 public:
  explicit AtomicFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The next file, to be written before the commit. Throws OutputError.
  AtomicFile& add(const std::string& name);
  /// Flushes all files, removes the `outdated` ones in their order, and renames the new ones in theirs. Files
  /// that are not outdated are the old or the new ones at any moment. Where something fails, all become the
  /// old ones again. A process that is killed between the first removal and the last renaming leaves a folder
  /// without the first of the outdated, if that is renamed last: never one of old and new files that looks
  /// whole. Writers of one folder wait for each other. Throws OutputError.
  void commit(const std::vector<std::string>& outdated);

 private:
  std::filesystem::path folder_;
  std::list<AtomicFile> files_;
};

/// Makes the folder (and its parents). Throws OutputError when it cannot be made or is not writable.
void make_output_folder(const std::filesystem::path& folder);

/// What the system says of `errno`.
std::string system_reason();

/// Throws OutputError; it says so where an older file stays.
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& why);

}  // namespace shelfbeam
