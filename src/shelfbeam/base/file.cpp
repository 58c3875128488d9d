#include "shelfbeam/base/file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

bool is_folder(const fs::path& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
  throw InputError(path.string(), fmt::format("cannot be written ({})", why),
                   "choose an existing folder that you may write to");
}

void flush_to_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) cannot_write(path, reason());
  const bool flushed = ::fsync(descriptor) == 0;
  const std::string why = reason();
  ::close(descriptor);
  if (!flushed) cannot_write(path, why);
}

}  // namespace

std::string read_file(const fs::path& path) {
  if (is_folder(path)) throw InputError(path.string(), "is a folder, not a file", "name the file in it");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string(), fmt::format("cannot be read ({})", reason()), "check the path");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) throw InputError(path.string(), "reading failed part-way", "check the disk");
  return text;
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!is_folder(folder)) cannot_write(target_, "the folder does not exist");
  if (is_folder(target_)) cannot_write(target_, "it is a folder");
  // Renaming over a device or a pipe would put a file in its place.
  std::error_code missing;
  if (fs::exists(target_, missing) && !fs::is_regular_file(target_, missing))
    cannot_write(target_, "it is no regular file");
  std::string pattern = (folder / ("." + target_.filename().string() + ".XXXXXX")).string();
  const int descriptor = ::mkstemp(pattern.data());
  if (descriptor < 0) cannot_write(target_, reason());
  ::fchmod(descriptor, 0644);
  ::close(descriptor);
  temporary_ = pattern;
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  flush_to_disk(temporary_);
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) cannot_write(target_, error.message());
  committed_ = true;
}

void write_file(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  {
    std::ofstream out(file.temporary(), std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.flush();
    if (!out) cannot_write(path, reason());
  }
  file.commit();
}

void make_output_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !is_folder(folder)) cannot_write(folder, error ? error.message() : "it is a file");
  if (::access(folder.c_str(), W_OK) != 0) cannot_write(folder, reason());
}

}  // namespace shelfbeam
