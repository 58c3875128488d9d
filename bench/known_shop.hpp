#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::bench {

/// The problem that a plan solves in a known shop.
struct KnownProblem {
  std::string_view name;
  bool adds_up = true;
  bool has_prices = false;
  std::vector<std::string> options;  ///< of `plan`
};

/// plain (cooperative), single (non-cooperative), weighted (prices per unit), and lexicographic (count, then
/// signal).
std::vector<KnownProblem> known_problems();

/// A small shop whose solutions are known from its reference, a long run of the paper's estimator with exact
/// direct light, by enumeration of all selections.
class KnownShop {
 public:
  static constexpr std::array<std::string_view, 4> names{"low", "aisles", "high", "back"};

  /// Reads the reference from `folder`, or simulates it with `samples` per label and writes it there. Throws
  /// std::invalid_argument for an unknown name.
  KnownShop(const std::filesystem::path& folder, const std::string& name, std::uint64_t samples);

  const SignalMatrix& reference() const { return reference_; }
  /// The prices of the units, as a file for `--costs`.
  const std::filesystem::path& prices_file() const { return prices_file_; }

  /// A requirement that the best selection of a certain number of units, or of its cost, meets by `margin`
  /// (negative: misses), and the solution there.
  struct Case {
    double requirement = 0;
    std::size_t count = 0;  ///< of the cheapest selection
    double cost = 0;        ///< of the cheapest selection: count or sum of prices
    std::filesystem::path store;
  };
  Case with_margin(const KnownProblem& problem, double margin) const;
  /// The requirement halfway between those that two consecutive costs can meet, where these differ the most.
  Case loose(const KnownProblem& problem) const;

  /// The signal of a selection at a label.
  struct Sum {
    double signal = 0;
    double error = 0;  ///< sum of the entries' standard errors
    /// The signal is at least three such errors from the requirement.
    bool is_clear = false;
    bool is_reached = false;
  };
  Sum sum(const KnownProblem& problem, double requirement, std::size_t label,
          std::span<const std::size_t> selected) const;

  double cost(const KnownProblem& problem, std::span<const std::size_t> selected) const;

 private:
  struct Best {
    double signal = 0;  ///< of the weakest label
    double cost = 0;
    std::size_t count = 0;
  };
  Case with_file(const KnownProblem& problem, double requirement) const;
  Case case_of(const KnownProblem& problem, double requirement) const;
  std::vector<Best> selections(const KnownProblem& problem) const;
  double critical(const KnownProblem& problem, std::size_t units) const;

  std::string name_;
  std::filesystem::path folder_, prices_file_;
  SignalMatrix reference_;
};

}  // namespace shelfbeam::bench
