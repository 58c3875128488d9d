#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/operator/preview.hpp"

namespace shelfbeam {

/// The simulated signals of the units of a plan.
struct PlanSignals {
  SignalMatrix matrix;                  ///< rows in the order of the scene's labels
  std::vector<std::uint32_t> selected;  ///< columns
  PlacementProblem problem = {};        ///< of the plan
};

/// A label with the units of a plan, and with changed units, in the signal's unit of measure: its received
/// signal by the problem of the plan.
struct LabelWhatIf {
  double requirement = 0;
  double before = 0;
  double after = 0, error = 0;  ///< with the standard error of simulated and previewed signals
  std::uint8_t doubts = 0;      ///< as in Preview

  bool was_reached() const { return is_met(before, requirement); }
  bool is_reached() const { return is_met(after, requirement); }
  /// Whether 95 % of the truths include both answers.
  bool is_close() const;
  /// Share of the requirement; infinite without one.
  double margin() const;
};

/// The labels if units are added to a plan, moved or removed. Without a plan, all units are added ones.
struct WhatIf {
  PlacementProblem problem = {};
  bool has_plan = false;
  bool is_simulated = false;         ///< all signals are unbiased
  std::vector<Transceiver> added;    ///< moved units, too
  std::vector<std::string> removed;  ///< moved units, too
  std::vector<LabelWhatIf> labels;   ///< in the order of the scene

  std::size_t reached() const;
  std::size_t gained() const;
  std::size_t lost() const;
  std::size_t close() const;
  std::size_t doubtful() const;
  /// Labels in the order of their margins, the weakest first.
  std::vector<std::uint32_t> weakest() const;
};

/// The columns of the plan's units without the removed ones. Throws InputError for a removed unit that is not
/// part of the plan.
std::vector<std::uint32_t> kept_units(const std::optional<PlanSignals>& plan,
                                      const std::vector<std::string>& removed);

/// `change`: everything but problem and labels. Errors of added units count as independent. Throws as
/// kept_units.
WhatIf what_if(const Scene& scene, const std::optional<PlanSignals>& plan, WhatIf change,
               std::span<const Preview> added);

}  // namespace shelfbeam
