#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::bench {

/// A small shop under a low ceiling, with labels a hand's breadth above the floor, and its reference: a long
/// run of the paper's estimator with exact direct light. The requirement is chosen so that `units` candidates
/// reach all labels by 1 %, and fewer do not.
class LowShop {
 public:
  static constexpr std::size_t units = 3;

  /// Reads the reference from `folder`, or simulates it with `samples` per label and writes it there. Writes
  /// the store file beside it. Throws std::runtime_error if the reference is too short to show that `units`
  /// suffice and fewer do not.
  LowShop(const std::filesystem::path& folder, std::uint64_t samples);

  const std::filesystem::path& file() const { return file_; }
  const SignalMatrix& reference() const { return reference_; }
  double requirement() const { return requirement_; }
  /// The smallest signal of the best selection of `units`, and of one fewer, relative to the requirement,
  /// minus 1.
  double margin() const { return margin_; }
  double margin_of_fewer() const { return margin_of_fewer_; }

  const std::vector<std::size_t>& best() const { return best_; }

  /// The signal of a selection at a label.
  struct Sum {
    double signal = 0;
    double error = 0;  ///< sum of the entries' standard errors
    /// The signal is at least three such errors from the requirement.
    bool is_clear = false;
    bool is_reached = false;
  };
  Sum sum(std::size_t label, std::span<const std::size_t> selected) const;

 private:
  void choose_requirement();
  void check() const;

  std::filesystem::path file_;
  SignalMatrix reference_;
  double requirement_ = 0, margin_ = 0, margin_of_fewer_ = 0;
  std::vector<std::size_t> best_;
};

}  // namespace shelfbeam::bench
