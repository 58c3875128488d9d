#include "serve/project/regular_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/files/file_time.hpp"
#include "shelfbeam/base/files/found_file.hpp"

namespace shelfbeam::serve {

namespace {

FileStamp stamp_from(const struct stat& state) {
  return {state.st_ino, static_cast<std::uint64_t>(state.st_size), ns_of(state.st_mtim)};
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat state = {};
  if (::lstat(path.c_str(), &state) != 0) return std::nullopt;
  return stamp_from(state);
}

std::optional<std::int64_t> change_time(const std::filesystem::path& path) {
  struct stat state = {};
  if (::lstat(path.c_str(), &state) != 0) return std::nullopt;
  return ns_of(state.st_ctim);
}

std::optional<FileContent> read_regular_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  FoundFile found = find_file_itself(path);
  if (found.error == ENOENT) return std::nullopt;
  const auto fail = [&](const std::string& problem, const char* remedy) {
    throw InputError(path.string(), problem, remedy);
  };
  if (found.error == ELOOP) fail("is a symbolic link", "replace it by the file that it names");
  if (found.exists() && !found.is_regular()) fail("is not a regular file", "move it elsewhere");
  if (!found.file.is_open())
    fail(fmt::format("cannot be read ({})", std::generic_category().message(found.error)),
         "check its permissions");
  const FileStamp stamp = stamp_from(found.state);
  return FileContent{InputFile(path, std::move(found)).read(max_bytes), stamp};
}

}  // namespace shelfbeam::serve
