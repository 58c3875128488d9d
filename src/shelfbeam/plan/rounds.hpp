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

/// What fresh samples are for. Those of one purpose in one round are of no other.
enum class Purpose : std::uint64_t { verify = 1, bound, refine };

/// Budget, levels and random numbers of rounds r = 1, 2, ... that together keep one joint level.
class Rounds {
 public:
  static constexpr std::uint32_t growth = 4;  ///< of the batches, from round to round
  static constexpr std::uint32_t most_batches = 1 << 16;
  /// Paths a label and batch, at least: batches of fewer are so skewed that limits do not hold.
  static constexpr std::uint64_t least_paths = 256;

  /// The simulation's seed is that of the planning matrix.
  Rounds(double confidence, const RoundBudget& budget, const SimulationOptions& simulation)
      : error_(1 - confidence), budget_(budget), simulation_(with_enough_paths(simulation)) {}

  /// The same simulation with batches that limits can be made of.
  static SimulationOptions with_enough_paths(SimulationOptions simulation) {
    simulation.relative_error.reset();
    simulation.time_s.reset();
    simulation.samples = std::max(simulation.samples, least_paths * batch_count);
    return simulation;
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  /// Tells of first rays that were taken.
  void spend(std::uint64_t samples) { samples_ += samples; }
  bool counts_samples() const { return budget_.samples.has_value(); }
  /// In the budget's unit: seconds or first rays.
  double spent() const { return counts_samples() ? static_cast<double>(samples_) : seconds(); }
  double left() const {
    return (counts_samples() ? static_cast<double>(*budget_.samples) : budget_.seconds) - spent();
  }
  std::string_view unit() const { return counts_samples() ? "samples" : "s"; }

  /// Begins the next one; the first is 1.
  void next() { ++round_; }
  std::uint32_t round() const { return round_; }
  /// For each of so many statements that round r makes: a_r / statements with a_r = (1 - confidence) / 2^r,
  /// so that all rounds together keep sum_r a_r = 1 - confidence, however many there are and whatever ends
  /// them.
  double level(int statements) const { return std::ldexp(error_, -static_cast<int>(round_)) / statements; }
  VerificationEffort effort(Purpose purpose, std::uint32_t batches) const;

  static std::uint32_t more(std::uint32_t batches) {
    return batches < most_batches / growth ? growth * batches : most_batches;
  }

 private:
  double error_;
  RoundBudget budget_;
  SimulationOptions simulation_;
  std::uint32_t round_ = 0;
  std::uint64_t samples_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Verdicts on labels, made in rounds of more and more batches.
class LabelRounds {
 public:
  LabelRounds(const Scene& scene, std::vector<LabelVerdict>& labels) : scene_(scene), labels_(labels) {}

  /// Verifies some labels at the units that are selected (verification.hpp). `planned`: their signals on the
  /// matrix, row by row.
  void verify(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& selected,
              const Question& question, std::span<const float> planned, Rounds& rounds, double level,
              const RunControl& control);

  /// Takes more batches from now on.
  void grow() { batches_ = Rounds::more(batches_); }

  std::uint32_t batches() const { return batches_; }
  /// Of the budget, as all that follows.
  double cost_of_next() const { return Rounds::growth * took_; }
  /// Until all is decided, if the means are where the truth is; endless where one is its requirement.
  double cost_to_decide() const;

 private:
  const Scene& scene_;
  std::vector<LabelVerdict>& labels_;
  std::uint32_t batches_ = least_verifying_batches;
  double took_ = 0;
};

/// "the next round would have taken about 40 s, and 12 s were left", or the like: why another round of a
/// certificate is not worth its time; empty where it is. `cost_of_next` is that of the whole round.
std::string why_no_more(const Rounds& rounds, const LabelRounds& labels, double cost_of_next);

/// Verifies units that hang already, all transceivers of the scene, in rounds as `certify` does, until every
/// label is reached or missed: the certificate says nothing of a bound.
/// Which links must do where units do not cooperate is decided on a simulation of its own, as the options
/// say. Throws as `simulate`.
CertifiedPlan verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                                  const RunControl& control = {});

}  // namespace shelfbeam
