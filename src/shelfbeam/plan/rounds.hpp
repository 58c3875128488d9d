#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {

/// Purposes of independent samples. Samples of one purpose in one round serve no other.
enum class Purpose : std::uint64_t { verify = 1, bound, refine };

/// Budget, levels and random numbers of rounds r = 1, 2, ... that share one joint level.
class Rounds {
 public:
  static constexpr std::uint32_t growth = 4;  ///< factor of the batches from round to round
  static constexpr std::uint32_t max_batches = 1 << 16;
  /// Minimum paths per label and batch: smaller batches are so skewed that limits fail too often.
  static constexpr std::uint64_t min_paths = 256;

  /// The simulation's seed is that of the planning matrix.
  Rounds(double confidence, const RoundBudget& budget, const SimulationOptions& simulation)
      : error_(1 - confidence), budget_(budget), simulation_(with_enough_paths(simulation)) {}

  /// The simulation with batches that are suitable for confidence limits.
  static SimulationOptions with_enough_paths(SimulationOptions simulation) {
    simulation.relative_error.reset();
    simulation.time_s.reset();
    simulation.samples = std::max(simulation.samples, min_paths * batch_count);
    return simulation;
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  /// Adds samples to the amount spent.
  void spend(std::uint64_t samples) { samples_ += samples; }
  bool counts_samples() const { return budget_.samples.has_value(); }
  /// In the budget's unit of measure: seconds or samples.
  double spent() const { return counts_samples() ? static_cast<double>(samples_) : seconds(); }
  double left() const {
    return (counts_samples() ? static_cast<double>(*budget_.samples) : budget_.seconds) - spent();
  }
  std::string_view unit() const { return counts_samples() ? "samples" : "s"; }

  /// Begins the next round; the first is 1.
  void next() { ++round_; }
  std::uint32_t round() const { return round_; }
  /// The level of each of `statements` statements of round r: a_r / statements with a_r = (1 - confidence) /
  /// 2^r. All rounds together keep sum_r a_r = 1 - confidence, whatever their number and the reason for their
  /// end.
  double level(int statements) const { return std::ldexp(error_, -static_cast<int>(round_)) / statements; }
  VerificationEffort effort(Purpose purpose, std::uint32_t batches) const;

  static std::uint32_t more(std::uint32_t batches) {
    return batches < max_batches / growth ? growth * batches : max_batches;
  }

 private:
  double error_;
  RoundBudget budget_;
  SimulationOptions simulation_;
  std::uint32_t round_ = 0;
  std::uint64_t samples_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Verdicts on labels, in rounds of growing numbers of batches.
class LabelRounds {
 public:
  LabelRounds(const Scene& scene, std::vector<LabelVerdict>& labels) : scene_(scene), labels_(labels) {}

  /// Verifies some labels for the selected units (verification.hpp). `planned`: their signals on the matrix,
  /// row by row.
  void verify(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& selected,
              const PlacementProblem& problem, std::span<const float> planned, Rounds& rounds, double level,
              const RunControl& control);

  /// Increases the number of batches.
  void grow() { batches_ = Rounds::more(batches_); }

  std::uint32_t batches() const { return batches_; }
  /// In the budget's unit of measure, like all costs below.
  double cost_of_next() const { return Rounds::growth * took_; }
  /// Cost to decide all labels if the means are the true signals; infinite if a mean equals the requirement.
  double cost_to_decide() const;

 private:
  const Scene& scene_;
  std::vector<LabelVerdict>& labels_;
  std::uint32_t batches_ = min_verifying_batches;
  double took_ = 0;
};

/// The reason why another round of a certificate is not worth its time, such as "the next round would have
/// taken about 40 s, but 12 s were left"; empty if it is. `cost_of_next` is the cost of the whole round.
std::string stop_reason(const Rounds& rounds, const LabelRounds& labels, double cost_of_next);

/// Verifies mounted units, all transceivers of the scene, in rounds as `certify` does, until every label is
/// reached or missed. The certificate has no lower bound. Non-cooperative: a simulation with `options` plans
/// the link of each label. Throws as `simulate`.
CertifiedPlan verify_installation(const Scene& scene, const PlacementProblem& problem,
                                  const CertifyOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
