#include "serve/project/store_file.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve {
namespace fs = std::filesystem;

namespace {

// Whether it got the name; errno is EEXIST if the name is taken.
bool gets_name(const fs::path& from, const fs::path& name) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(from, error)))
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0;
  // A second name costs nothing. File systems without such names need a copy.
  if (::link(from.c_str(), name.c_str()) == 0) return true;
  if (errno == EEXIST) return false;
  fs::copy_file(from, name, fs::copy_options::none, error);
  errno = error.value();
  return !error;
}

}  // namespace

void StoreFile::expect_valid(const std::string& text) const {
  expect_valid(text, parse_json(text, path_.string(), max_document));
}

void StoreFile::expect_valid(const std::string& text, const Json& value) const {
  if (text.size() > max_store_text)
    throw InputError(
        path_.string(),
        fmt::format("has {} bytes; the maximum is {}", grouped(text.size()), grouped(max_store_text)),
        "put long lists into files of their own");
  if (!value.is_object()) throw InputError(path_.string(), "is not a JSON object { ... }", "write one");
  if (check_) check_(value);
}

std::optional<FileStamp> StoreFile::put(const std::string& text, const std::string* old) const {
  AtomicFile file(path_);
  file.write(text);
  const auto stamp = stamp_of(file.temporary());
  if (!old)
    file.commit();
  else if (!file.commit_over(*old))
    return std::nullopt;
  return stamp;
}

void StoreFile::set_aside() const {
  constexpr int most = 10'000;
  for (int number = 1; number <= most; ++number) {
    const fs::path name = fmt::format("{}.outside-{}", path_.string(), number);
    if (gets_name(path_, name)) return;
    if (errno != EEXIST) cannot_write(name, system_reason());
  }
  cannot_write(path_, "too many files of such names");
}

}  // namespace shelfbeam::serve
