#include "shelfbeam/scene/store_folder.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

// Both without symbolic links.
bool lies_below(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

StoreFolder::StoreFolder(fs::path folder, const StoreTrust& trust)
    : folder_(folder.empty() ? fs::path(".") : std::move(folder)), trust_(trust) {}

fs::path StoreFolder::find(const JsonCursor& name) const {
  return find(name.text(), name.where(), "file");
}

fs::path StoreFolder::find(const fs::path& name, const std::string& where, const std::string& what) const {
  fs::path path = folder_ / name;
  if (path.native().find('\0') != std::string::npos)
    throw InputError(where, "names a file by a text with a zero in it", "correct the name");
  std::error_code error;
  if (!trust_.allow_outside) {
    // Also of what does not exist, so that an error does not tell what lies elsewhere.
    const fs::path home = fs::weakly_canonical(fs::absolute(folder_), error);
    const fs::path target = error ? fs::path() : fs::weakly_canonical(fs::absolute(path), error);
    if (error || !lies_below(target, home))
      throw InputError(where, fmt::format("'{}' lies outside the folder of the store file", name.string()),
                       "move it there, or trust the store file with '--allow-outside'");
  }
  if (fs::is_directory(path, error))
    throw InputError(where, fmt::format("'{}' is a folder", path.string()), "name a file in it");
  if (!fs::is_regular_file(path, error))
    throw InputError(where, fmt::format("the {} '{}' does not exist", what, path.string()),
                     "paths are relative to the store file");
  return path;
}

}  // namespace shelfbeam
