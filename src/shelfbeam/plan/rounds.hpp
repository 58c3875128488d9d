#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/answer/end_reason.hpp"
#include "shelfbeam/plan/answer/round_budget.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

/// Purposes of independent samples. Samples of one purpose in one round serve no other.
enum class Purpose : std::uint64_t { verify = 1, bound, refine };

/// The units for which a label is sampled: the chosen ones, or all candidates.
enum class TracedUnits { chosen, all };

/// Drives rounds r = 1, 2, ... that share one joint level: budget, costs, levels, random numbers and end.
class Rounds {
 public:
  static constexpr std::uint32_t growth = 4;  ///< factor of the batches from round to round
  static constexpr std::uint32_t min_batches = 32, max_batches = 1 << 16;
  /// Minimum samples per label and batch: smaller batches are so skewed that limits fail too often.
  static constexpr std::uint64_t min_samples = 256;

  /// `statements`: of each round. The seed is that of the question.
  Rounds(double confidence, int statements, const RoundBudget& budget, std::uint64_t seed,
         const RunControl& control)
      : error_((1 - confidence) / statements), budget_(budget), seed_(seed), control_(control) {}

  /// Runs `work`, which returns the reason why it leaves something open, if any.
  template <class Work>
  static std::optional<EndReason> reason_after(const Work& work) {
    try {
      return work();
    } catch (const Interrupted&) {
      return EndReason{EndCause::interrupted};
    }
  }

  double seconds() const { return watch_.seconds(); }
  bool counts_samples() const { return budget_.samples.has_value(); }
  /// In the budget's unit of measure: seconds or samples.
  double spent() const { return counts_samples() ? static_cast<double>(samples_) : seconds(); }
  /// `cause`, unless the budget is spent.
  EndReason stop_reason(EndCause cause) const { return {left() > 0 ? cause : EndCause::budget}; }
  double left() const {
    return (counts_samples() ? static_cast<double>(*budget_.samples) : budget_.seconds) - spent();
  }
  /// An effort in the budget's unit as time; 0 if it counts samples.
  double in_seconds(double effort) const { return counts_samples() ? 0 : effort; }
  /// The time for a search: a share of the time that is left, or `otherwise` if the budget is in samples.
  double seconds_for(double share, double otherwise) const {
    return counts_samples() ? otherwise : share * std::max(0.0, left());
  }

  /// First rays per label and batch of every request.
  static double samples_per_batch(const PreparedScene& prepared);

  /// Begins the next round; the first is 1.
  void next() { ++round_; }
  std::uint32_t round() const { return round_; }
  /// The level of each statement of round r: a_r / statements with a_r = (1 - confidence) / 2^r. Some
  /// statement of some round is wrong with probability at most sum_r a_r = 1 - confidence, for any dependence
  /// between them (Bonferroni), any number of rounds and any reason for their end.
  double level() const { return std::ldexp(error_, -static_cast<int>(round_)); }
  const RunControl& control() const { return control_; }
  void report(Task task, std::string_view detail) const;
  /// Batches of some labels in this round; `part` distinguishes requests of one purpose.
  BatchRequest request(Purpose purpose, std::span<const LabelId> labels, std::uint32_t batches,
                       std::uint32_t part = 0) const;

  /// The batches of a test that fit into the budget that is left, at `cost` per batch: the `wanted` ones,
  /// which contain a reserve, or fewer if these are at least half of the `needed` ones; 0 if too few fit.
  std::uint32_t affordable(double wanted, double needed, double cost) const;

  /// The cost of a batch of a label, in the budget's unit of measure, as last measured; 0: not yet. Before
  /// the first batch for all candidates, it is estimated from that for the chosen units, which takes at least
  /// a third of the time.
  double cost(TracedUnits units) const {
    if (units == TracedUnits::chosen || cost_of_all_ > 0)
      return units == TracedUnits::chosen ? cost_of_chosen_ : cost_of_all_;
    return (counts_samples() ? 1 : 3) * cost_of_chosen_;
  }
  /// Counts the samples of new batches, and measures their cost; `begun`: spent() before them.
  void measure(TracedUnits units, double begun, std::uint64_t samples, double batches);
  void measure(double begun, std::span<const ValidationRow> fresh);  ///< for all candidates

  static std::uint32_t more(std::uint32_t batches) {
    return batches < max_batches / growth ? growth * batches : max_batches;
  }

 private:
  double error_;
  RoundBudget budget_;
  std::uint64_t seed_;
  const RunControl& control_;
  std::uint32_t round_ = 0;
  std::uint64_t samples_ = 0;
  double cost_of_chosen_ = 0, cost_of_all_ = 0;
  Stopwatch watch_;
};

/// Verdicts on the labels of one selection, in rounds. Every label gets the batches that it is expected to
/// need.
class LabelRounds {
 public:
  /// `labels`: one verdict per label of the scene, which the rounds fill in.
  LabelRounds(const Scene& scene, const SimulationOptions& simulation, std::vector<LabelVerdict>& labels)
      : scene_(scene), simulation_(simulation), labels_(labels) {}

  /// Selects the units and forgets all verdicts. `planned`: their signals on the matrix, row by row.
  /// `is_final`: no other selection replaces them, even if they miss labels.
  void select(const PlacementProblem& problem, Selection selected, std::vector<float> planned, bool is_final);

  /// Verifies open labels with independent samples and returns their number. Open are the labels that lack
  /// the joint statement, as long as it can hold for all, and otherwise the labels that the list leaves
  /// undecided. The labels of a new selection begin with the `riskiest_labels` of the smallest planned
  /// margins. If one of these seems to be missed and the selection is not final, the others are left for a
  /// later round. Labels that would exceed the budget are omitted, the most expensive first.
  std::size_t verify(Rounds& rounds);
  static constexpr std::size_t riskiest_labels = 256;

  /// Labels whose estimated signal is below the requirement, or so little above that many batches have not
  /// decided them.
  std::vector<LabelId> undecided_labels() const;
  /// The reason why labels stay open.
  EndReason obstacle(const Rounds& rounds) const;

 private:
  struct Need {
    double batches = 0;
    LabelId label;
  };
  std::vector<Need> needs(double level) const;
  static std::size_t shrink_to_budget(const Rounds& rounds, std::vector<Need>& needs);
  bool holds_jointly() const;
  std::vector<double> planned_margins() const;
  void sample_classes(std::span<const Need> needs, std::uint32_t& part, Rounds& rounds,
                      const VerdictLevels& levels);
  void sample(std::vector<LabelId> rows, std::uint32_t batches, std::uint32_t part, Rounds& rounds,
              const VerdictLevels& levels);

  const Scene& scene_;
  SimulationOptions simulation_;
  std::vector<LabelVerdict>& labels_;
  PlacementProblem problem_;
  Selection selected_;
  std::vector<float> planned_;
  std::vector<double> margins_;  ///< planned signals, as shares of the requirements; 0: unknown
  bool is_final_ = true;
  std::optional<Scene> part_;
  std::unique_ptr<const PreparedScene> prepared_;
  std::vector<bool> passes_;            ///< has met its requirement at the level of the joint statement
  std::vector<std::uint32_t> batches_;  ///< of the present estimate; 0: none
  bool aims_at_all_ = true;             ///< the joint statement can still hold
  /// Labels omitted from the last round because they exceed the budget.
  struct Skipped {
    std::size_t labels = 0;
    double cost = 0;
  } skipped_;
};

}  // namespace shelfbeam
