#include "shelfbeam/base/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "shelfbeam/base/files/access.hpp"
#include "shelfbeam/base/files/descriptor.hpp"
#include "shelfbeam/base/files/open_file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Locks the open file. The lock ends with the process, even if the process is killed. `command` selects
// whether to wait.
bool lock(int descriptor, int command, short type = F_WRLCK) {
  struct flock whole = {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  return ::fcntl(descriptor, command, &whole) == 0;
}

constexpr auto other_name = "choose another name";
constexpr std::string_view random_part = "XXXXXX";

std::string temporary_prefix(const fs::path& target) {
  return "." + target.filename().string() + ".shelfbeam-";
}

// A temporary file of this name contains the process that uses the target.
constexpr std::string_view lock_part = "locked";
static_assert(lock_part.size() == random_part.size());

// " (process 123)" from a file that the process has locked; empty if it has not written its number.
std::string owner_in(int descriptor) {
  std::string number(32, '\0');
  for (int attempt = 0; attempt < 50; ++attempt) {
    const ssize_t size = ::pread(descriptor, number.data(), number.size(), 0);
    if (size > 1 && number[static_cast<std::size_t>(size) - 1] == '\n')
      return fmt::format(" (process {})", number.substr(0, static_cast<std::size_t>(size) - 1));
    ::usleep(2000);
  }
  return {};
}

bool is_unlinked(int descriptor) {
  struct stat state = {};
  return ::fstat(descriptor, &state) != 0 || state.st_nlink == 0;
}

// After a rename, flushes the folder to disk too, if the file system supports that.
void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

// Keeps the old file under a second, hidden name until the replacement has succeeded.
class BackupFile {
 public:
  explicit BackupFile(const fs::path& target) : target_(target) {
    remove_abandoned(target);
    descriptor_ = ::open(target.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENOENT) return;
    std::string name = (folder_of(target) / (temporary_prefix(target) + std::string(random_part))).string();
    const int unique = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0 || unique < 0) fail();
    ::close(unique);
    ::unlink(name.c_str());
    kept_ = name;
    // The lock protects the file from `remove_abandoned`. Without hard links, the kept file is a copy.
    lock(descriptor_, F_OFD_SETLK, F_RDLCK);
    if (::link(target.c_str(), kept_.c_str()) == 0) return;
    std::error_code error;
    fs::copy_file(target, kept_, error);
    if (!error) return;
    errno = error.value();
    fail();
  }
  ~BackupFile() { release(); }
  BackupFile(const BackupFile&) = delete;
  BackupFile& operator=(const BackupFile&) = delete;

  bool restore() {
    if (kept_.empty()) return ::unlink(target_.c_str()) == 0 || errno == ENOENT;
    // A folder or file that refused the replacement would refuse the same file again.
    return names(target_, descriptor_) || ::rename(kept_.c_str(), target_.c_str()) == 0 ||
           ::link(kept_.c_str(), target_.c_str()) == 0;
  }

 private:
  void release() {
    if (!kept_.empty()) ::unlink(kept_.c_str());
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[noreturn]] void fail() {
    const std::string reason = system_reason();
    release();
    cannot_write(target_, reason);
  }

  fs::path target_, kept_;
  int descriptor_ = -1;
};

FoundFile find_readable(const fs::path& path) {
  const auto fail = [&](const std::string& problem, const char* remedy) {
    throw InputError(path.string(), problem, remedy);
  };
  // The system would read another file, whose name ends at that character.
  if (path.native().find('\0') != std::string::npos)
    fail("is a file name with a null character", "remove it");
  FoundFile found = find_file(path);
  if (S_ISDIR(found.state.st_mode)) fail("is a folder, not a file", "name a file in it");
  if (found.exists() && !found.is_regular())
    fail("is not a regular file", "save its content to a file, and name that");
  if (!found.file.is_open())
    fail(fmt::format("cannot be read ({})", std::generic_category().message(found.error)), "check the path");
  return found;
}

}  // namespace

std::string system_reason() {
  return std::generic_category().message(errno);
}

void cannot_write(const fs::path& path, const std::string& why, const std::string& suggestion) {
  std::error_code unknown;
  const bool is_old = fs::is_regular_file(path, unknown);
  throw OutputError(path.string(),
                    fmt::format("cannot be written ({}){}", why, is_old ? " and is unchanged" : ""),
                    suggestion);
}

InputFile::InputFile(fs::path path) : path_(std::move(path)), found_(find_readable(path_)) {}

InputFile::InputFile(fs::path path, FoundFile found) : path_(std::move(path)), found_(std::move(found)) {}

void InputFile::expect_at_most(std::uint64_t max_bytes) const {
  if (size() > max_bytes)
    throw InputError(name(),
                     fmt::format("has {} bytes; the maximum is {}", grouped(size()), grouped(max_bytes)),
                     "check that it is the right file");
}

std::string InputFile::read(std::uint64_t max_bytes) const {
  expect_at_most(std::min<std::uint64_t>(max_bytes, memory_limit()));
  auto text = read_open(found_.file.number(), size());
  if (!text) throw InputError(name(), "cannot be read to its end", "check the disk");
  return std::move(*text);
}

std::uint64_t input_size(const fs::path& path, std::uint64_t max_bytes) {
  const InputFile file(path);
  file.expect_at_most(max_bytes);
  return file.size();
}

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  return InputFile(path).read(max_bytes);
}

std::string read_text(const fs::path& path, std::uint64_t max_bytes) {
  std::string text = read_file(path, max_bytes);
  text.erase(0, text.size() - without_mark(text, path.string()).size());
  return text;
}

void expect_format_version(const std::string& where, std::int64_t found, std::int64_t known) {
  if (found != known)
    throw InputError(where, fmt::format("has format version {}, but this program reads {}", found, known),
                     found > known ? "use a newer version of shelfbeam"
                                   : "use the version of shelfbeam that wrote it, or create it again");
}

void remove_abandoned(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + random_part.size()) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    // The lock is free if the writer has ended.
    if (lock(descriptor, F_OFD_SETLK)) ::unlink(entry->path().c_str());
    ::close(descriptor);
  }
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  if (!is_folder(folder_of(target_)))
    cannot_write(target_, "the folder does not exist", "create the folder, or choose another");
  if (is_folder(target_)) cannot_write(target_, "it is a folder", other_name);
  // A rename over a device or a pipe would replace it by a regular file.
  std::error_code missing;
  if (fs::exists(target_, missing) && !fs::is_regular_file(target_, missing))
    cannot_write(target_, "it is not a regular file", other_name);
  remove_abandoned(target_);
  const fs::path pattern = folder_of(target_) / (temporary_prefix(target_) + std::string(random_part));
  // Between creation and locking, another writer may remove the file as abandoned.
  for (;;) {
    std::string name = pattern.string();
    const int unique = ::mkostemp(name.data(), O_CLOEXEC);
    if (unique < 0) cannot_write(target_, system_reason());
    ::close(unique);
    ::unlink(name.c_str());
    // Other than `mkostemp`, this respects the user's mask of permissions.
    descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) cannot_write(target_, system_reason());
    temporary_ = name;
    lock(descriptor_, F_OFD_SETLKW);
    if (!is_unlinked(descriptor_)) break;
    ::close(descriptor_);
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
  ::close(descriptor_);
}

void AtomicFile::write(std::string_view content) {
  if (::ftruncate(descriptor_, 0) != 0 || !write_at(descriptor_, content, 0))
    cannot_write(target_, system_reason());
}

void AtomicFile::flush() {
  struct stat old = {};
  if (::stat(target_.c_str(), &old) == 0)
    take_access(descriptor_, old);
  else
    share_with_group(descriptor_, folder_of(target_));
  if (::fsync(descriptor_) != 0) cannot_write(target_, system_reason());
}

bool AtomicFile::rename() {
  committed_ = ::rename(temporary_.c_str(), target_.c_str()) == 0;
  return committed_;
}

void AtomicFile::commit() {
  flush();
  if (!rename()) cannot_write(target_, system_reason());
  flush_folder(folder_of(target_));
}

bool AtomicFile::exchange() {
  return ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
}

bool AtomicFile::commit_over(std::string_view content) {
  flush();
  if (!has_content(target_, content)) return false;
  if (exchange()) {
    // A file that was written since the look goes back, or the destructor would remove it.
    if (!has_content(temporary_, content)) {
      if (!exchange() && !rename()) cannot_write(target_, system_reason());
      return false;
    }
  } else {
    if (errno == ENOENT) return false;  // removed since the look
    if ((errno != EINVAL && errno != ENOSYS) || !rename()) cannot_write(target_, system_reason());
  }
  flush_folder(folder_of(target_));
  return true;
}

void write_file(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

AtomicFile& AtomicFolder::add(const std::string& name) {
  return files_.emplace_back(folder_ / name);
}

void AtomicFolder::commit(const std::vector<std::string>& outdated) {
  for (AtomicFile& file : files_) file.flush();
  const int descriptor = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) cannot_write(folder_, system_reason());
  const Descriptor locked(descriptor);
  ::flock(descriptor, LOCK_EX);
  std::list<BackupFile> kept;
  for (const std::string& name : outdated) kept.emplace_back(folder_ / name);
  for (const AtomicFile& file : files_)
    if (std::find(outdated.begin(), outdated.end(), file.target().filename()) == outdated.end())
      kept.emplace_back(file.target());
  const auto roll_back = [&](const fs::path& failed) {
    const std::string reason = system_reason();
    // The first outdated file is restored last, and only if all others were restored.
    for (auto file = kept.rbegin(); file != kept.rend() && file->restore(); ++file) {
    }
    cannot_write(failed, reason);
  };
  for (const std::string& name : outdated)
    if (::unlink((folder_ / name).c_str()) != 0 && errno != ENOENT) roll_back(folder_ / name);
  for (AtomicFile& file : files_)
    if (!file.rename()) roll_back(file.target());
  ::fsync(descriptor);
}

OutputLock::OutputLock(const fs::path& output, const std::string& name, const char* remedy)
    : path_(folder_of(output) / (temporary_prefix(output) + std::string(lock_part))) {
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    const int reason = errno;
    // Another user's lock can only be read, but in a folder that both may change also removed.
    const bool is_foreign = descriptor_ < 0 && reason == EACCES;
    if (is_foreign) descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    const bool is_locked = descriptor_ >= 0 && lock(descriptor_, F_OFD_SETLK, is_foreign ? F_RDLCK : F_WRLCK);
    if (descriptor_ >= 0 && !is_locked && (errno == EAGAIN || errno == EACCES)) {
      const std::string owner = owner_in(descriptor_);
      ::close(descriptor_);
      throw InputError(name, fmt::format("is in use by another run of shelfbeam{}", owner), remedy);
    }
    if (is_foreign && descriptor_ >= 0) {
      const bool is_removed = is_locked && names(path_, descriptor_) && ::unlink(path_.c_str()) == 0;
      ::close(descriptor_);
      if (is_removed) continue;
      cannot_write(path_, "another user's run left it", "delete it, or choose another output");
    }
    if (descriptor_ < 0) {
      std::error_code unknown;
      const bool is_there = fs::exists(fs::symlink_status(path_, unknown));
      cannot_write(is_there ? path_ : fs::path(name), std::generic_category().message(reason));
    }
    share_with_group(descriptor_, folder_of(path_));
    // The previous owner removes the file when it ends.
    if (!is_locked || !is_unlinked(descriptor_)) break;
    ::close(descriptor_);
  }
  const std::string owner = fmt::format("{}\n", ::getpid());
  // Without the number, the other process is not named.
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, owner.data(), owner.size(), 0) < 0) return;
}

OutputLock::~OutputLock() {
  if (names(path_, descriptor_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

void expect_room(const fs::path& folder, double bytes) {
  struct statvfs disk = {};
  if (::statvfs(folder.c_str(), &disk) != 0) return;
  const double room = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  if (room < bytes)
    cannot_write(folder, fmt::format("{:.3g} MB of disk space are needed, and {:.3g} MB are free",
                                     bytes / 1e6, room / 1e6));
}

std::optional<fs::path> keep_elsewhere(const std::function<void(const fs::path&)>& write) {
  std::error_code none;
  for (const fs::path& parent : {fs::temp_directory_path(none), fs::path("/var/tmp"), fs::path("/dev/shm")}) {
    std::string name = (parent / ("shelfbeam-" + std::string(random_part))).string();
    if (parent.empty() || ::mkdtemp(name.data()) == nullptr) continue;
    try {
      write(name);
      return name;
    } catch (const OutputError&) {
      fs::remove_all(name, none);
    }
  }
  return std::nullopt;
}

void make_output_folder(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> made;
  for (fs::path level = folder; !level.empty() && !fs::exists(level, error); level = level.parent_path())
    made.push_back(level);
  fs::create_directories(folder, error);
  for (auto level = made.rbegin(); level != made.rend(); ++level)
    if (const Descriptor opened(::open(level->c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)); opened.is_open())
      share_with_group(opened.number(), folder_of(*level));
  if (error || !is_folder(folder))
    cannot_write(folder, error ? error.message() : "it is a file", "choose another folder");
  if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) cannot_write(folder, system_reason());
}

void protect_input(const std::filesystem::path& output, const std::filesystem::path& input) {
  std::error_code missing;
  if (std::filesystem::equivalent(output, input, missing))
    throw InputError(output.string(), "is also the input and would be overwritten",
                     "choose another name for the output");
}

void expect_writable(const std::filesystem::path& output) {
  const AtomicFile probe(output);
}

}  // namespace shelfbeam
