#include "shelfbeam/scene/store_folder.hpp"

#include <algorithm>
#include <cerrno>
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

// The absolute path without symbolic links, whether or not it exists; empty if it cannot be known.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  return error ? fs::path() : fs::weakly_canonical(absolute, error);
}

// Without "." and "..", and without a slash at the end.
fs::path plain(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

// A folder lies in itself.
bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Precondition: both paths are resolved or plain. They may lead elsewhere by now, so the file is sought again
// from the folder.
FoundFile found_in(const fs::path& folder, const fs::path& file) {
  if (!folder.empty() && lies_in(file, folder))
    return find_file_below(folder, file.lexically_relative(folder));
  FoundFile outside;
  outside.error = EXDEV;
  return outside;
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

void StoreFolder::expect_few_fixtures(std::size_t count, const JsonCursor& entry) const {
  if (count > trust_.fixtures)
    entry.fail(fmt::format("makes {} fixtures together with those before it", grouped(count)),
               fmt::format("at most {} are allowed", grouped(trust_.fixtures)));
}

FoundFile StoreFolder::found(const fs::path& name) const {
  if (trust_.allow_outside) return find_file(folder_ / name);
  const fs::path home = folder_.empty() ? fs::path(".") : folder_;
  if (trust_.allow_links) return found_in(resolved(home), resolved(home / name));
  if (name.is_relative()) return find_file_below(home, name);
  std::error_code error;
  return found_in(plain(fs::absolute(home, error)), plain(name));
}

bool StoreFolder::is_output(const FoundFile& found) const {
  struct stat output = {};
  return !trust_.output.empty() && ::stat(trust_.output.c_str(), &output) == 0 &&
         output.st_dev == found.state.st_dev && output.st_ino == found.state.st_ino;
}

InputFile StoreFolder::find(const JsonCursor& name) const {
  return find(name.text(), name.where(), "file");
}

InputFile StoreFolder::find(const fs::path& name, const std::string& where, const std::string& what) const {
  const auto fail = [&](const std::string& problem, const char* remedy, Setting setting = Setting::none) {
    throw InputError(where, problem, remedy, setting);
  };
  if (name.empty()) fail("is an empty file name", "name a file");
  fs::path path = folder_ / name;
  if (path.native().find('\0') != std::string::npos)
    fail("is a file name with a null character", "remove it");
  FoundFile file = found(name);
  const std::string quoted = path_in_quotes(path);
  // The same whether or not the file exists: the error does not reveal which files exist elsewhere.
  if (file.error == EXDEV)
    fail(fmt::format("{} is outside the folder of the store file", path_in_quotes(name)),
         trust_.outside_remedy, Setting::files_outside);
  if (file.error == ELOOP && !trust_.allow_links)
    fail(fmt::format("{} is a symbolic link, or lies behind one", quoted),
         "replace the link by what it names");
  if (S_ISDIR(file.state.st_mode)) fail(fmt::format("{} is a folder", quoted), "name a file in it");
  if (file.exists() && !file.is_regular())
    fail(fmt::format("{} is not a regular file", quoted), "save its content to a file, and name that");
  if (!file.exists())
    fail(fmt::format("the {} {} does not exist", what, quoted), "paths are relative to the store file");
  if (!file.file.is_open())
    fail(fmt::format("{} cannot be read ({})", quoted, std::generic_category().message(file.error)),
         "check its permissions");
  const bool is_the_output = is_output(file);
  InputFile input(std::move(path), std::move(file));
  if (input.size() > trust_.file_size)
    fail(fmt::format("{} has {} bytes; the maximum is {}", quoted, grouped(input.size()),
                     grouped(trust_.file_size)),
         "use a smaller file");
  if (is_the_output)
    fail(fmt::format("{} is also the output and would be overwritten", quoted),
         "choose another name for the output");
  return input;
}

}  // namespace shelfbeam
