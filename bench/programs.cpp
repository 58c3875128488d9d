#include "programs.hpp"

#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam::bench {

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

pid_t start(std::vector<std::string>& command) {
  std::vector<char*> arguments(command.size() + 1, nullptr);
  for (std::size_t k = 0; k < command.size(); ++k) arguments[k] = command[k].data();
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t id = 0;
  const int failed = ::posix_spawnp(&id, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + command[0]);
  return id;
}

}  // namespace

std::string this_program() {
  return SHELFBEAM_BINARY;
}

Ended run_program(std::vector<std::string> command) {
  const pid_t id = start(command);
  int status = 0;
  rusage used{};  // of this child process only
  if (::wait4(id, &status, 0, &used) != id || !WIFEXITED(status))
    throw std::runtime_error(fmt::format("'{}' was ended by a signal", fmt::join(command, " ")));
  return {WEXITSTATUS(status), seconds(used.ru_utime) + seconds(used.ru_stime)};
}

Simulated simulate_with(const std::string& program, const std::filesystem::path& store,
                        const std::vector<std::string>& options, std::uint64_t seed) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "signal.h5";
  std::vector<std::string> command{
      program, "simulate", store.string(),       "-o",     file.string(), "--threads",
      "1",     "--seed",   std::to_string(seed), "--quiet"};
  command.insert(command.end(), options.begin(), options.end());
  const Ended ended = run_program(command);
  if (ended.exit_code != 0)
    throw std::runtime_error(
        fmt::format("'{}' ended with exit code {}", fmt::join(command, " "), ended.exit_code));
  return {read_signal_file(file), ended.cpu_seconds};
}

}  // namespace shelfbeam::bench
