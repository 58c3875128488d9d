#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shelfbeam::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + n after signal n
  std::string out, err;
};

/// A program that runs in parallel to the test. Its output is written to files, so it never waits for a
/// reader.
class Process {
 public:
  explicit Process(std::vector<std::string> command) {
    std::vector<char*> arguments(command.size() + 1, nullptr);
    for (std::size_t i = 0; i < command.size(); ++i) arguments[i] = command[i].data();
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, out_.descriptor, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, err_.descriptor, STDERR_FILENO);
    const int failed = ::posix_spawn(&id_, arguments[0], &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + command[0]);
  }
  ~Process() {
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
  }
  /// Waits until a file has visibly changed `times` times, or the program has ended.
  void wait_for_changes(const std::filesystem::path& file, int times) const {
    for (std::filesystem::file_time_type known{}; times > 0 && !has_ended();) {
      std::error_code missing;
      const auto changed = std::filesystem::last_write_time(file, missing);
      if (!missing && changed != known) {
        known = changed;
        --times;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void send(int signal) const { ::kill(id_, signal); }

  Outcome wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), out_.text(), err_.text()};
  }

 private:
  // A file without a name.
  struct Sink {
    Sink() {
      std::string name = (std::filesystem::temp_directory_path() / "shelfbeam-test-XXXXXX").string();
      descriptor = ::mkostemp(name.data(), O_CLOEXEC);
      if (descriptor < 0) throw std::runtime_error("cannot make a temporary file");
      ::unlink(name.c_str());
    }
    ~Sink() { ::close(descriptor); }
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;

    std::string text() const {
      std::string content(static_cast<std::size_t>(::lseek(descriptor, 0, SEEK_END)), '\0');
      const ssize_t got = ::pread(descriptor, content.data(), content.size(), 0);
      content.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
      return content;
    }
    int descriptor;
  };

  Sink out_, err_;
  pid_t id_ = 0;
};

/// Runs a program (by its full path) to its end.
inline Outcome run(std::vector<std::string> command) {
  return Process(std::move(command)).wait();
}

}  // namespace shelfbeam::test
