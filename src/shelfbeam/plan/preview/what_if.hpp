#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/operator/preview.hpp"

namespace shelfbeam {

/// The units before a change, of a plan or chosen by the store.
struct UnitsBefore {
  std::vector<std::string> ids = {};
  std::vector<Preview> columns = {};  ///< by unit: previews, or simulated signals without doubts
  PlacementProblem problem = {};      ///< of the plan
};

/// Whether 95 % of the truths include both answers to the question whether a signal meets its requirement.
bool is_undecided(double signal, double error, double requirement);

/// A label with the units before a change, and after it, in the signal's unit of measure: its received signal
/// by the problem of the plan.
struct LabelWhatIf {
  double requirement = 0;
  double before = 0;
  double after = 0, error = 0;  ///< with the standard error of simulated and previewed signals
  std::uint8_t doubts = 0;      ///< as in Preview

  bool was_reached() const { return is_met(before, requirement); }
  bool is_reached() const { return is_met(after, requirement); }
  bool is_close() const { return is_undecided(after, error, requirement); }
  /// Share of the requirement; infinite without one.
  double margin() const;
};

/// The labels if units are added, moved or removed. If there are none before, all units are added ones.
struct WhatIf {
  PlacementProblem problem = {};
  bool has_before = false;
  bool is_simulated = false;         ///< all signals are unbiased
  std::vector<Transceiver> added;    ///< moved units, too
  std::vector<std::string> removed;  ///< moved units, too
  std::vector<LabelWhatIf> labels;   ///< in the order of the scene

  /// Whether there is anything to compare.
  bool has_change() const { return has_before && !(added.empty() && removed.empty()); }
  std::size_t reached() const;
  std::size_t gained() const;
  std::size_t lost() const;
  std::size_t close() const;
  std::size_t doubtful() const;
  /// Labels in the order of their margins, the weakest first.
  std::vector<LabelId> weakest() const;
};

/// The numbers of the units without the removed ones. Throws InputError for a removed unit that is not among
/// them.
std::vector<std::uint32_t> kept_units(const std::optional<UnitsBefore>& before,
                                      const std::vector<std::string>& removed);

/// `change`: everything but problem and labels. Errors of added units count as independent. Throws as
/// kept_units.
WhatIf what_if(const Scene& scene, const std::optional<UnitsBefore>& before, WhatIf change,
               std::span<const Preview> added);

}  // namespace shelfbeam
