#include "jobs/child.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <functional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shelfbeam::jobs {

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void fail(const char* action) {
  throw std::system_error(errno, std::generic_category(), action);
}

// A file in memory without a name, so that the child never waits for a reader or a writer.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("shelfbeam-output", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail("the output of a program cannot be kept");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  void fill(std::string_view text) const {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t written =
          ::pwrite(descriptor_, text.data() + at, text.size() - at, static_cast<off_t>(at));
      if (written < 0) fail("the input of a program cannot be kept");
      at += static_cast<std::size_t>(written);
    }
  }
  // The text from a position on, of a large file the end only.
  std::string end_of_text(off_t begin = 0) const { return text(std::max(begin, size() - max_size)); }
  // The text from a position on, of a large file not all at once.
  std::string text(off_t begin) const {
    std::string content(static_cast<std::size_t>(std::clamp<off_t>(size() - begin, 0, max_size)), '\0');
    const ssize_t got = ::pread(descriptor_, content.data(), content.size(), begin);
    content.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return content;
  }
  // Frees the memory of the text before a position.
  void forget_before(off_t end) const {
    if (end > 0) ::fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, end);
  }

 private:
  static constexpr off_t max_size = 64 << 20;

  off_t size() const { return ::lseek(descriptor_, 0, SEEK_END); }

  int descriptor_;
};

// Makes only calls that are safe between fork and exec.
std::function<int()> execution(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return [pointers = std::move(pointers)] {
    ::execvp(pointers[0], pointers.data());
    return 127;
  };
}

}  // namespace

struct Child::State {
  MemoryFile in, out, err;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  pid_t id = 0;
  off_t read = 0;   ///< of `out`
  off_t freed = 0;  ///< of `out`
};

Child::Child(std::vector<std::string> words, std::uint64_t memory, std::string_view input)
    : Child(execution(words), memory, input) {}

Child::Child(const std::function<int()>& work, std::uint64_t memory, std::string_view input)
    : state_(std::make_unique<State>()) {
  state_->in.fill(input);
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  state_->id = ::fork();
  if (state_->id < 0) fail("a program cannot be started");
  if (state_->id > 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  ::setpgid(0, 0);  // signals of a terminal reach the parent only, which passes them on
  if (memory > 0) {
    const rlimit limit{memory, memory};
    ::setrlimit(RLIMIT_DATA, &limit);
  }
  ::dup2(state_->in.descriptor(), STDIN_FILENO);
  ::dup2(state_->out.descriptor(), STDOUT_FILENO);
  ::dup2(state_->err.descriptor(), STDERR_FILENO);
  ::_exit(work());
}

Child::~Child() {
  if (!state_ || state_->id <= 0) return;
  ::kill(state_->id, SIGKILL);
  ::waitpid(state_->id, nullptr, 0);
}

Child::Child(Child&&) noexcept = default;
Child& Child::operator=(Child&&) noexcept = default;

void Child::interrupt() const {
  if (state_->id > 0) ::kill(state_->id, SIGINT);
}

void Child::kill() const {
  if (state_->id > 0) ::kill(state_->id, SIGKILL);
}

void Child::pause() const {
  if (state_->id > 0) ::kill(state_->id, SIGSTOP);
}

void Child::resume() const {
  if (state_->id > 0) ::kill(state_->id, SIGCONT);
}

void Child::give_way() const {
  constexpr int niceness = 5;
  if (state_->id > 0) ::setpriority(PRIO_PROCESS, static_cast<id_t>(state_->id), niceness);
}

std::string Child::new_output() {
  std::string text = state_->out.text(state_->read);
  state_->read += static_cast<off_t>(text.size());
  return text;
}

std::string Child::take_output() {
  std::string text = new_output();
  state_->freed = state_->read;
  state_->out.forget_before(state_->freed);
  return text;
}

bool Child::has_ended(ChildEnd& end) {
  int status = 0;
  rusage usage{};
  const pid_t found = ::wait4(state_->id, &status, WNOHANG, &usage);
  if (found == 0 || (found < 0 && errno == EINTR)) return false;
  if (found < 0) fail("the end of a program is unknown");
  state_->id = 0;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.out = state_->out.end_of_text(state_->freed);
  end.err = state_->err.end_of_text();
  end.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  end.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - state_->started).count();
  end.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return true;
}

void wait_for_children(double seconds) {
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGCHLD);
  sigset_t before;
  ::pthread_sigmask(SIG_BLOCK, &ends, &before);
  siginfo_t info{};
  if (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0) {
    const auto whole = static_cast<time_t>(seconds);
    const timespec time{whole, static_cast<long>(1e9 * (seconds - static_cast<double>(whole)))};
    ::sigtimedwait(&ends, nullptr, &time);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace shelfbeam::jobs
