#pragma once

#include <filesystem>

#include <sys/stat.h>

namespace shelfbeam {

/// Gives a file that replaces an older one the owner, group and mode of that, as far as this user may. A file
/// of another group than before is open to it as to all others only.
void take_access(int descriptor, const struct stat& old);

/// Opens a new file or folder to its group as the folder around it is, whatever the user's mask, if a group
/// works in that folder: files in it get its group, which may write to it.
void share_with_group(int descriptor, const std::filesystem::path& folder);

}  // namespace shelfbeam
