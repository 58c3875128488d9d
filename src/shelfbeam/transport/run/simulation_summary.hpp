#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// Relative standard errors of the entries above a share of their label's requirement, good to 1 %.
struct ErrorQuantiles {
  double above = 0;
  std::uint64_t entries = 0, flagged = 0;  ///< flagged: the error is not to be trusted (SignalMatrix::flags)
  double median = 0, p90 = 0, p99 = 0;
};

/// An entry that kept a simulation from the relative error that was asked for.
struct UnmetEntry {
  std::string label, source;  ///< ids
  double relative_error = 0;
  bool is_flagged = false;       ///< SignalMatrix::flags
  bool is_out_of_reach = false;  ///< whether more samples, up to RelativeError::most_samples, would not help
};

/// What a simulation did and how good its matrix is.
struct SimulationSummary {
  bool complete = true;  ///< false: cancelled; the rows say how many batches each label got
  std::size_t labels = 0, candidates = 0;
  std::uint64_t least_samples = 0, most_samples = 0;  ///< first rays a label
  std::optional<std::uint64_t> asked_samples;         ///< where their number was to end the simulation
  std::uint32_t least_batches = 0, most_batches = 0;
  std::uint64_t batches = 0;          ///< of all items of the work
  std::uint64_t resumed_batches = 0;  ///< of these, what came from the checkpoint
  bool has_checkpoint = false;        ///< that this run has saved or gone on from
  std::uint64_t rays = 0;             ///< traced in this run, not before a resumption
  ShadowRays shadow_rays;             ///< of these; all 0 where no walks from labels are connected
  double seconds = 0;                 ///< of this run
  double seconds_to_halve = 0;        ///< predicted from there on, until the errors are half as large
  /// A relative error that was asked for and is out of reach (RelativeError::most_samples), how many entries
  /// fall short of it, how many of these would at the end, too, and the worst of them.
  std::optional<double> unmet_error;
  std::uint64_t unmet = 0, out_of_reach = 0;
  std::vector<UnmetEntry> worst_unmet;
  std::array<ErrorQuantiles, 2> errors = {{{0.3}, {0.02}}};
};

}  // namespace shelfbeam
