#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam::jobs {

/// The end of a child process.
struct ChildEnd {
  int exit_code = -1;  ///< 128 + n after signal n
  std::string out, err;
  double cpu_s = 0, wall_s = 0;
  std::uint64_t peak_memory = 0;  ///< bytes
};

/// The path of this program, for a child.
inline constexpr auto own_program = "/proc/self/exe";

/// Another process. It ends with its parent, however this ends.
class Child {
 public:
  /// `words`: the program and its arguments. `memory`: limit of its data in bytes; 0: none. `input`: its
  /// standard input. A program that cannot be run ends with code 127. Throws std::system_error.
  explicit Child(std::vector<std::string> words, std::uint64_t memory = 0, std::string_view input = {});
  /// A copy of this process that runs `work`, which returns the exit code. Only for a process with one
  /// thread.
  explicit Child(const std::function<int()>& work, std::uint64_t memory = 0, std::string_view input = {});
  /// Kills it if it has not ended.
  ~Child();
  Child(Child&&) noexcept;
  Child& operator=(Child&&) noexcept;

  /// Asks it to end with its results so far.
  void interrupt() const;
  /// Ends it at once.
  void kill() const;
  /// Stops it where it is, until `resume`.
  void pause() const;
  void resume() const;
  /// Other processes come first from now on. To be called before it has several threads.
  void give_way() const;
  /// Its standard output since the last call; of much output only the next part.
  std::string new_output();
  /// The same, and frees its memory: ChildEnd::out does not repeat it.
  std::string take_output();
  /// Whether it has ended; fills `end` then.
  bool has_ended(ChildEnd& end);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// An interval in which an ended child, or a signal, is always noticed.
inline constexpr double poll_s = 0.5;
/// Waits until a child of this process changes its state, a signal arrives, or the time is over.
void wait_for_children(double seconds);

}  // namespace shelfbeam::jobs
