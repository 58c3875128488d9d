#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace shelfbeam::serve {

/// What the folder tells about a file: if it changes, the content may have changed.
struct FileStamp {
  std::uint64_t inode = 0, bytes = 0;
  std::int64_t modified_ns = 0;  ///< since 1970

  bool operator==(const FileStamp&) const = default;
};

/// The stamp of what has this name, even if that is a link; nothing if the name is free.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

/// When content, name or permissions of what has this name last changed, in ns since 1970. Programs cannot
/// set this time. Nothing if the name is free.
std::optional<std::int64_t> change_time(const std::filesystem::path& path);

struct FileContent {
  std::string content;
  FileStamp stamp;  ///< of the same file, from before it was read
};

/// Reads a regular file; does not follow a symbolic link in the place of the file. Returns nothing if the
/// name is free. Throws InputError if something else has the name, if the file has more than `max_bytes`, and
/// if it cannot be read.
std::optional<FileContent> read_regular_file(const std::filesystem::path& path, std::uint64_t max_bytes);

}  // namespace shelfbeam::serve
