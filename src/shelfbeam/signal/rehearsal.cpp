#include "shelfbeam/signal/detail/rehearsal.hpp"

#include <cerrno>
#include <csignal>
#include <fstream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shelfbeam::detail {

namespace {

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) return;
  if (now.rlim_cur == RLIM_INFINITY || most < now.rlim_cur) now.rlim_cur = most;
  ::setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

// Bytes of addresses that the process uses.
rlim_t used_addresses() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void act(const std::function<void()>& action) {
  // A crash is an answer here: nobody's handler, and no core, need hear of it.
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) ::signal(crash, SIG_DFL);
  try {
    action();
  } catch (...) {
  }
  ::_exit(0);
}

}  // namespace

bool ends_well(const std::function<void()>& action, std::chrono::seconds seconds, std::size_t memory) {
  const rlim_t addresses = used_addresses() + memory;
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) {
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<rlim_t>(seconds.count()));
    limit(RLIMIT_AS, addresses);
    act(action);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace shelfbeam::detail
