#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace shelfbeam {

/// The whole file as text. Throws InputError when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// A file that appears under its name only when it is complete: write to `temporary()`, then `commit()`.
/// Without a commit the temporary file is removed and an older file of that name stays as it was.
class AtomicFile {
 public:
  /// Throws InputError when the folder does not exist or cannot be written to.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes to the disk and renames. Throws InputError when that fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Writes `content` to `path` through an AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Makes the folder (and its parents). Throws InputError when it cannot be made or is not writable.
void make_output_folder(const std::filesystem::path& folder);

}  // namespace shelfbeam
