#include "shelfbeam/scene/store_folder.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

// The absolute path without symbolic links, whether or not it exists.
fs::path resolved(const fs::path& path, std::error_code& error) {
  const fs::path absolute = fs::absolute(path, error);
  return error ? fs::path() : fs::weakly_canonical(absolute, error);
}

// Precondition: both paths are resolved. A folder lies in itself.
bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Longer paths are not those of a user.
std::string path_in_quotes(const fs::path& path) {
  return fmt::format("'{}'", shortened(path.string(), 250));
}

}  // namespace

StoreFolder::StoreFolder(fs::path folder, const StoreLimits& trust)
    : folder_(std::move(folder)), trust_(trust) {}

std::size_t StoreFolder::memory() const {
  return std::max(trust_.memory == 0 ? memory_limit() : trust_.memory, min_memory);
}

fs::path StoreFolder::find(const JsonCursor& name) const {
  return find(name.text(), name.where(), "file");
}

fs::path StoreFolder::find(const fs::path& name, const std::string& where, const std::string& what) const {
  if (name.empty()) throw InputError(where, "is an empty file name", "name a file");
  fs::path path = folder_ / name;
  if (path.native().find('\0') != std::string::npos)
    throw InputError(where, "is a file name with a null character", "remove it");
  std::error_code error;
  if (!trust_.allow_outside) {
    // Checked before existence, so that the error does not reveal which files exist elsewhere.
    const fs::path home = resolved(folder_.empty() ? "." : folder_, error);
    const fs::path target = error ? fs::path() : resolved(path, error);
    if (error || !lies_in(target, home))
      throw InputError(where, fmt::format("{} is outside the folder of the store file", path_in_quotes(name)),
                       "move it there, or allow files outside it", Setting::files_outside);
  }
  if (fs::is_directory(path, error))
    throw InputError(where, fmt::format("{} is a folder", path_in_quotes(path)), "name a file in it");
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    throw InputError(where, fmt::format("{} is not a regular file", path_in_quotes(path)),
                     "save its content to a file, and name that");
  if (!fs::exists(path, error))
    throw InputError(where, fmt::format("the {} {} does not exist", what, path_in_quotes(path)),
                     "paths are relative to the store file");
  const std::uint64_t size = fs::file_size(path, error);
  if (!error && size > trust_.file_size)
    throw InputError(where,
                     fmt::format("{} has {} bytes; the maximum is {}", path_in_quotes(path), grouped(size),
                                 grouped(trust_.file_size)),
                     "use a smaller file");
  if (!trust_.output.empty() && fs::equivalent(path, trust_.output, error))
    throw InputError(where,
                     fmt::format("{} is also the output and would be overwritten", path_in_quotes(path)),
                     "choose another name for the output");
  return path;
}

}  // namespace shelfbeam
