#pragma once

#include <filesystem>

#include <sys/stat.h>

#include "shelfbeam/base/files/descriptor.hpp"

namespace shelfbeam {

/// What has a name. A regular file is open for reading, so that its checks and its bytes are those of one
/// file, even if its name is given to another meanwhile. Pipes and devices are neither opened nor waited for.
struct FoundFile {
  Descriptor file;  ///< open if it is a regular file that can be read
  struct stat state = {};
  int error = 0;  ///< as errno

  bool exists() const { return state.st_mode != 0; }
  bool is_regular() const { return S_ISREG(state.st_mode); }
};

/// Precondition for all: the paths have no null character.
FoundFile find_file(const std::filesystem::path& path);

/// The same, but not through a symbolic link in the place of the file (ELOOP). Its folder may be a link.
FoundFile find_file_itself(const std::filesystem::path& path);

/// The same for a path in a folder. No part of it may be a symbolic link (ELOOP), and it must not leave the
/// folder (EXDEV), whatever other programs do in the folder meanwhile. The path of the folder itself may have
/// links.
FoundFile find_file_below(const std::filesystem::path& folder, const std::filesystem::path& path);

}  // namespace shelfbeam
