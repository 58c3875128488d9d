#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::bench {

/// A small shop under a low ceiling, with labels a hand's breadth above the floor, and what is known of it: a
/// long run of the paper's estimator with exact direct light. Its requirement is such that `units` of its
/// candidates reach all labels by 1 % and fewer do not.
class LowShop {
 public:
  static constexpr std::size_t units = 3;

  /// Takes the reference from `folder`, or simulates it with so many samples per label and leaves it there,
  /// and writes the store file beside it. Throws std::runtime_error where the reference is too short to tell
  /// that so many units suffice and fewer do not.
  LowShop(const std::filesystem::path& folder, std::uint64_t samples);

  const std::filesystem::path& file() const { return file_; }
  const SignalMatrix& reference() const { return reference_; }
  double requirement() const { return requirement_; }
  /// By how much the best selection of `units` surpasses the requirement at its worst label; and of one less.
  double margin() const { return margin_; }
  double margin_of_fewer() const { return margin_of_fewer_; }

  const std::vector<std::size_t>& best() const { return best_; }

  /// A label at a selection.
  struct Sum {
    double signal = 0;
    double error = 0;  ///< standard error, were all entries wrong by theirs to the same side
    /// Three such errors from the requirement.
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
