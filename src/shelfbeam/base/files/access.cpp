#include "shelfbeam/base/files/access.hpp"

#include <unistd.h>

namespace shelfbeam {

void take_access(int descriptor, const struct stat& old) {
  constexpr auto same = static_cast<uid_t>(-1);
  // Only root may give a file away, but its owner may give it to any group of theirs.
  bool has_group =
      ::fchown(descriptor, old.st_uid, old.st_gid) == 0 || ::fchown(descriptor, same, old.st_gid) == 0;
  struct stat now = {};
  has_group = has_group || (::fstat(descriptor, &now) == 0 && now.st_gid == old.st_gid);
  mode_t mode = old.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
  if (!has_group) mode &= ~static_cast<mode_t>(S_IRWXG) | ((mode & S_IRWXO) << 3);
  ::fchmod(descriptor, mode);
}

void share_with_group(int descriptor, const std::filesystem::path& folder) {
  struct stat around = {}, own = {};
  if (::stat(folder.c_str(), &around) != 0 || ::fstat(descriptor, &own) != 0) return;
  const bool is_shared = (around.st_mode & S_ISGID) != 0 && (around.st_mode & S_IWGRP) != 0;
  if (!is_shared || own.st_gid != around.st_gid) return;
  const mode_t rights = S_ISDIR(own.st_mode) ? S_IRWXG : S_IRGRP | S_IWGRP;
  ::fchmod(descriptor, (own.st_mode | (around.st_mode & rights)) & 07777);
}

}  // namespace shelfbeam
