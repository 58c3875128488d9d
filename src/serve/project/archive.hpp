#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace shelfbeam::serve {

/// Pages receive an archive as a whole.
inline constexpr std::uint64_t max_archived_bytes = std::uint64_t{512} << 20;

struct ArchiveSize {
  std::size_t files = 0;
  std::uint64_t bytes = 0;  ///< of the zip file
};

/// Writes a project as one zip file: its store, the files that the store names, and its plans, in a folder
/// with the name of the project. Omits hidden files, of which the history is one, checkpoints, and symbolic
/// links. Throws InputError if the folder has no store.json or a file cannot be read, and OutputError.
ArchiveSize write_archive(const std::filesystem::path& project, const std::filesystem::path& zip);

}  // namespace shelfbeam::serve
