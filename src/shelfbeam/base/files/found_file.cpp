#include "shelfbeam/base/files/found_file.hpp"

#include <cerrno>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

enum class Links { followed, refused };

FoundFile not_found(int error) {
  FoundFile found;
  found.error = error;
  return found;
}

bool is_link(int folder, const char* name) {
  struct stat state = {};
  return ::fstatat(folder, name, &state, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(state.st_mode);
}

FoundFile found_at(int folder, const char* name, Links links) {
  const bool follows = links == Links::followed;
  FoundFile found;
  // The first look keeps the opening away from pipes and devices, on which it may have effects. The second
  // one is at what has been opened.
  if (::fstatat(folder, name, &found.state, follows ? 0 : AT_SYMLINK_NOFOLLOW) != 0) return not_found(errno);
  if (S_ISLNK(found.state.st_mode)) return not_found(ELOOP);
  if (!found.is_regular()) return found;
  constexpr int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  Descriptor file(::openat(folder, name, follows ? flags : flags | O_NOFOLLOW));
  if (!file.is_open() && errno == ELOOP) return not_found(ELOOP);
  if (!file.is_open() || ::fstat(file.number(), &found.state) != 0)
    found.error = errno;
  else if (found.is_regular())
    found.file = std::move(file);
  return found;
}

// A folder and the folders in it that lead to a place. The way back is that of the descriptors: a folder that
// is moved elsewhere meanwhile has another parent.
class Way {
 public:
  explicit Way(const fs::path& folder) {
    folders_.emplace_back(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    error_ = folders_.back().is_open() ? 0 : errno;
  }

  int error() const { return error_; }
  int end() const { return folders_.back().number(); }

  bool enter(const std::string& name) {
    if (error_ != 0 || name == ".") return error_ == 0;
    if (name == "..") return leave();
    Descriptor next(::openat(end(), name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next.is_open()) {
      error_ = errno;
      if (error_ == ENOTDIR && is_link(end(), name.c_str())) error_ = ELOOP;
      return false;
    }
    folders_.push_back(std::move(next));
    return true;
  }

 private:
  bool leave() {
    if (folders_.size() == 1)
      error_ = EXDEV;
    else
      folders_.pop_back();
    return error_ == 0;
  }

  std::vector<Descriptor> folders_;
  int error_ = 0;
};

}  // namespace

FoundFile find_file(const fs::path& path) {
  return found_at(AT_FDCWD, path.c_str(), Links::followed);
}

FoundFile find_file_itself(const fs::path& path) {
  return find_file_below("." / path.parent_path(), path.filename());
}

FoundFile find_file_below(const fs::path& folder, const fs::path& path) {
  if (path.is_absolute()) return not_found(EXDEV);
  Way way(folder);
  std::string name = ".";
  for (const fs::path& part : path) {
    if (!way.enter(name)) return not_found(way.error());
    name = part.empty() ? "." : part.string();
  }
  if (name == ".." && way.enter(name)) name = ".";
  if (way.error() != 0) return not_found(way.error());
  return found_at(way.end(), name.c_str(), Links::refused);
}

}  // namespace shelfbeam
