#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// Cancels long work. Any thread and a signal handler may set it. The work checks it between steps and then
/// ends early with its results so far.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// The parts of long work that report progress.
enum class Task : std::uint8_t {
  reading_the_stores,
  planning,
  preparing,
  simulating,
  simulating_states,
  reading_states,
  placing,
  placing_over_states,
  solving,
  bound,
  multipliers,
  windows,
  tree_search,
  local_search,
  annealing,
  verifying,
  proving,
  refining,
  fresh_states,
  curve,
  sensitivity
};

template <>
inline constexpr auto names_of<Task> =
    std::to_array<Named<Task>>({{"reading the stores", Task::reading_the_stores},
                                {"planning", Task::planning},
                                {"preparing", Task::preparing},
                                {"simulating", Task::simulating},
                                {"simulating states", Task::simulating_states},
                                {"reading states", Task::reading_states},
                                {"placing", Task::placing},
                                {"placing over states", Task::placing_over_states},
                                {"solving", Task::solving},
                                {"bound", Task::bound},
                                {"multipliers", Task::multipliers},
                                {"windows", Task::windows},
                                {"tree search", Task::tree_search},
                                {"local search", Task::local_search},
                                {"annealing", Task::annealing},
                                {"verifying", Task::verifying},
                                {"proving", Task::proving},
                                {"refining", Task::refining},
                                {"fresh states", Task::fresh_states},
                                {"curve", Task::curve},
                                {"sensitivity", Task::sensitivity}});

/// Receives the progress of long work. Only one thread calls it at a time.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` is in [0, 1], or negative when the end is unknown; `detail` is a short free text.
  virtual void report(Task task, double fraction, std::string_view detail) = 0;
  /// The value of the best placement so far and a proven lower bound; comes before a report.
  virtual void bounds(double /*incumbent*/, double /*lower_bound*/) {}
  /// The ids of the units of the best placement so far; comes after `bounds`.
  virtual void selection(const std::vector<std::string>& /*ids*/) {}
};

/// Threads, cancellation and progress of a long computation. All are optional, and none changes a result.
struct RunControl {
  unsigned threads = 0;  ///< 0: all cores
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;

  bool cancelled() const { return cancel != nullptr && cancel->requested(); }
  void report(Task task, double fraction, std::string_view detail = {}) const {
    if (progress != nullptr) progress->report(task, fraction, detail);
  }
};

}  // namespace shelfbeam
