#include "shelfbeam/signal/hdf5/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shelfbeam::detail {

namespace {

// One end of a pipe, closed with its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

// A process that is waited for, whatever happens here.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { ends_well(); }

  bool ends_well() {
    if (id_ == 0) return false;
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  pid_t id_;
};

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

[[noreturn]] void act(const std::function<void(PipeWriter&)>& give, int descriptor) {
  // A crash is an answer here: nobody's handler, and no core, need hear of it. Ctrl-C is for the parent to
  // answer.
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE})
    ::signal(crash, SIG_DFL);
  try {
    PipeWriter pipe(descriptor);
    give(pipe);
    pipe.flush();
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

bool through_child(const std::function<void(PipeWriter&)>& give, const std::function<void(PipeReader&)>& take,
                   std::chrono::seconds seconds, std::size_t memory) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("a pipe to a process that reads a file");
  Descriptor from(ends[0]), to(ends[1]);
  const rlim_t addresses = used_addresses() + memory;
  const pid_t id = ::fork();
  if (id < 0) fail("a process that reads a file");
  if (id == 0) {
    from.close();
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<rlim_t>(seconds.count()));
    limit(RLIMIT_AS, addresses);
    act(give, to.number());
  }
  Child child(id);
  to.close();
  bool is_taken = true;
  try {
    PipeReader pipe(from.number(), memory);
    take(pipe);
  } catch (const BrokenPipe&) {
    is_taken = false;
  } catch (...) {
    from.close();  // before the child is waited for, so that one which goes on sending ends
    throw;
  }
  from.close();
  return child.ends_well() && is_taken;
}

}  // namespace shelfbeam::detail
