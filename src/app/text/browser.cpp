#include "app/text/browser.hpp"

#include <cstdlib>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::app {

namespace {

bool has_desktop() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

void write_private(const std::filesystem::path& path, const std::string& content) {
  ::unlink(path.c_str());
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) cannot_write(path, system_reason());
  const bool is_whole = ::write(file, content.data(), content.size()) == static_cast<ssize_t>(content.size());
  if (::close(file) != 0 || !is_whole) cannot_write(path, system_reason());
}

}  // namespace

void open_browser(const std::string& address, const std::filesystem::path& folder) {
  if (!has_desktop()) return;
  const std::string page = std::filesystem::absolute(folder / "open.html").string();
  write_private(
      page,
      fmt::format("<!doctype html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">"
                  "<meta http-equiv=\"refresh\" content=\"0;url={}\"><title>shelfbeam</title>\n",
                  address));
  // The browser outlives this program, so it is no child of it.
  const pid_t first = ::fork();
  if (first == 0) {
    ::setsid();
    if (::fork() == 0) {
      const int nowhere = ::open("/dev/null", O_RDWR);
      for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
      ::execlp("xdg-open", "xdg-open", page.c_str(), static_cast<char*>(nullptr));
    }
    ::_exit(0);
  }
  if (first > 0) ::waitpid(first, nullptr, 0);
}

}  // namespace shelfbeam::app
