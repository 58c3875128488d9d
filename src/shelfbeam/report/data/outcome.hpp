#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

/// 10 log10(signal / requirement); minus infinity without signal, plus infinity without requirement.
double margin_db(double signal, double requirement);

/// The effect of a placement on one label.
struct LabelOutcome {
  double signal = 0;  ///< S_i: sum over the chosen units (cooperative), or the largest (non-cooperative);
                      ///< for redundant problems without the strongest unit
  double direct = 0;  ///< the part of `signal` that arrives without any reflection
  double requirement = 0;  ///< gamma tau
  double best = 0;         ///< maximum signal, from the best option of every mounting point together
  bool met = false;        ///< signal >= requirement (1 - met_tolerance)
  /// Without its flagged entries (SignalMatrix::flags) the label is not met, and no certificate decides it.
  bool depends_on_flagged = false;
  std::optional<std::uint32_t> strongest;  ///< column of the chosen unit with the largest entry above 0
  std::vector<std::uint32_t> reached_by;   ///< columns of the chosen units that alone reach it (l_ij = 1)

  double margin() const { return margin_db(signal, requirement); }
  /// The signal as a multiple of the requirement; 0 without requirement.
  double ratio() const { return requirement > 0 ? signal / requirement : 0; }
};

/// The effect of one chosen unit.
struct UnitOutcome {
  std::uint32_t column = 0;
  std::uint32_t reaches_alone = 0;  ///< labels with l_ij = 1
  std::uint32_t strongest_for = 0;  ///< labels that receive their largest signal from it
  std::uint32_t needed_by = 0;      ///< labels that are met only because of it
};

/// A placement seen from every label and every chosen unit, recomputed from the matrix in double precision.
struct Outcome {
  std::vector<LabelOutcome> labels;
  std::vector<UnitOutcome> units;             ///< in the order of Placement::selected
  std::vector<LabelId> by_margin;             ///< labels, smallest margin first
  std::size_t met = 0;                        ///< labels that are met
  std::size_t secure = 0;                     ///< labels that stay met if any one chosen unit fails
  std::size_t met_by_direct_light = 0;        ///< labels that direct light alone would meet
  std::size_t flagged_labels = 0;             ///< labels that rest on flagged entries
  std::size_t redundant = 0;                  ///< labels that two or more chosen units each reach (Table 3.1)
  std::vector<double> direct_shares() const;  ///< direct / signal of every label with signal, label order

  /// Labels that chosen unit k reaches alone; without any, the labels for which it is strongest.
  std::vector<LabelId> served_by(std::size_t k) const;
};

Outcome outcome_of(const SignalMatrix& matrix, const Placement& placement,
                   const std::optional<Certificate>& certificate = {});

}  // namespace shelfbeam
