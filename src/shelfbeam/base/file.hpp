#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/files/found_file.hpp"

namespace shelfbeam {

/// Maximum sizes of input files, bytes. Matrices are limited by the memory instead.
inline constexpr std::uint64_t max_text_file = std::uint64_t{1} << 30, max_mesh_file = std::uint64_t{1} << 31,
                               max_photometry_file = std::uint64_t{1} << 24;

/// A regular file that is open for reading.
class InputFile {
 public:
  /// Throws InputError if the path is not a regular file that can be read.
  explicit InputFile(std::filesystem::path path);
  /// `path`: its name in messages. Precondition: `found.file` is open.
  InputFile(std::filesystem::path path, FoundFile found);

  const std::filesystem::path& path() const { return path_; }
  std::string name() const { return path_.string(); }
  /// When it was opened.
  const struct stat& state() const { return found_.state; }
  /// Bytes when it was opened.
  std::uint64_t size() const { return static_cast<std::uint64_t>(found_.state.st_size); }
  /// Throws InputError if it has more bytes.
  void expect_at_most(std::uint64_t max_bytes) const;
  /// All bytes. Throws InputError if they cannot be read, or are more than `max_bytes` or than fit in memory.
  std::string read(std::uint64_t max_bytes = max_text_file) const;

 private:
  std::filesystem::path path_;
  FoundFile found_;
};

/// The size of an input file in bytes. Throws InputError if the path is not a regular file that can be read
/// (never waits for a pipe), or has more than `max_bytes`.
std::uint64_t input_size(const std::filesystem::path& path,
                         std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());

/// All bytes of the file. Throws InputError when it cannot be read, and before reading when it has more than
/// `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = max_text_file);
/// The same without a byte order mark. Throws InputError, too, if the text is UTF-16 or UTF-32.
std::string read_text(const std::filesystem::path& path, std::uint64_t max_bytes = max_text_file);

/// Upper limit of version numbers in files; no real version reaches it.
inline constexpr std::int64_t max_versions = 1'000'000;

/// Checks the version of a file format. Versions count from 1 and change whenever older programs would
/// misread the file. Throws InputError at `where` unless `found` is the version that this program reads; the
/// message states whether a newer or an older program is required. Call it before reading the rest of the
/// file, because other versions may have other contents.
void expect_format_version(const std::string& where, std::int64_t found, std::int64_t known);

/// A file that appears under its name only when it is complete: write to `temporary()`, then `commit()`.
/// Without a commit, the destructor removes the temporary file, and an older file of that name is unchanged.
///
/// A file in the place of an older one keeps its owner, group and mode where possible; a new one in a folder
/// in which a group works is open to the group (files/access.hpp).
///
/// Temporary files are called `.NAME.shelfbeam-XXXXXX` and are locked while their writer runs. The next
/// writer of that name therefore recognises and removes the files of killed writers.
class AtomicFile {
 public:
  /// Throws OutputError when the folder does not exist or cannot be written to.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Writes the whole file. Throws OutputError.
  void write(std::string_view content);
  /// Flushes the content to disk, so that only the renaming remains. Throws OutputError.
  void flush();
  /// Flushes and renames. Throws OutputError.
  void commit();
  /// The same in the place of a file with this content. If that has another one, it stays, and the result is
  /// false: even if another program writes it at this moment, where the file system can exchange names.
  bool commit_over(std::string_view content);

 private:
  friend class AtomicFolder;
  bool rename();
  bool exchange();

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;  ///< holds the lock
  bool committed_ = false;
};

/// Removes the temporary files that killed writers of `target` left behind.
void remove_abandoned(const std::filesystem::path& target);

/// Writes `content` to `path` through an AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Throws InputError if the output would overwrite the input.
void protect_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Throws InputError if the output cannot be written, before any long work begins.
void expect_writable(const std::filesystem::path& output);

/// Files of one folder that must be replaced together.
class AtomicFolder {
 public:
  explicit AtomicFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Adds a file, which the caller writes before the commit. Throws OutputError.
  AtomicFile& add(const std::string& name);
  const std::list<AtomicFile>& files() const { return files_; }
  /// Flushes all files, removes the `outdated` files in the given order, and renames the new files in the
  /// order in which they were added. If a step fails, all old files are restored. A file that is not outdated
  /// exists at every moment, old or new. Rename the first outdated file last: it is then missing if the
  /// process is killed in between, so a mixture of old and new files never looks complete. Writers of one
  /// folder wait for each other. Throws OutputError.
  void commit(const std::vector<std::string>& outdated);

 private:
  std::filesystem::path folder_;
  std::list<AtomicFile> files_;
};

/// Marks an output as in use until the process ends, even if it is killed. Where the file system has no
/// locks, it does nothing.
class OutputLock {
 public:
  /// Errors name the output as `name`. Throws InputError with the other process and `remedy` if one uses the
  /// output, and OutputError when the folder of the output cannot be written to.
  OutputLock(const std::filesystem::path& output, const std::string& name,
             const char* remedy = "wait until it ends, or choose another output");
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  std::filesystem::path path_;  ///< contains the number of the process; `remove_abandoned` knows its name
  int descriptor_ = -1;
};

/// Throws OutputError if the disk of an existing folder has less room than this.
void expect_room(const std::filesystem::path& folder, double bytes);

/// Saves a result whose own folder cannot be written to: calls write(folder) with a new folder for temporary
/// files, on another disk if necessary. Returns this folder; nothing if the result cannot be written
/// anywhere.
std::optional<std::filesystem::path> keep_elsewhere(
    const std::function<void(const std::filesystem::path&)>& write);

/// Creates the folder and its parents. Throws OutputError if the folder cannot be created, read or written
/// to.
void make_output_folder(const std::filesystem::path& folder);

/// The system's message for `errno`.
std::string system_reason();

/// Throws OutputError. The message mentions an older file at `path`, which stays unchanged.
[[noreturn]] void cannot_write(
    const std::filesystem::path& path, const std::string& why,
    const std::string& suggestion = "choose an existing, writable folder with enough disk space");

}  // namespace shelfbeam
