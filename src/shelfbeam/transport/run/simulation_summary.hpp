#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// Relative standard errors of the entries above a share of their label's requirement, accurate to 1 %.
struct ErrorQuantiles {
  double above = 0;
  std::uint64_t entries = 0, flagged = 0;  ///< flagged: the error is not reliable (SignalMatrix::flags)
  double median = 0, p90 = 0, p99 = 0;
};

/// An entry that did not reach the required relative error.
struct UnmetEntry {
  std::string label, source;  ///< ids
  double relative_error = 0;
  bool is_flagged = false;       ///< SignalMatrix::flags
  bool is_out_of_reach = false;  ///< whether even RelativeError::max_samples would not suffice
};

/// The effort of a simulation and the errors of its matrix.
struct SimulationSummary {
  bool complete = true;  ///< false: cancelled; the rows give the number of batches of each label
  std::size_t labels = 0, candidates = 0;
  std::uint64_t min_samples = 0, max_samples = 0;  ///< first rays per label, over all labels
  std::optional<std::uint64_t> requested_samples;  ///< SimulationOptions::samples, if they end the simulation
  std::uint32_t min_batches = 0, max_batches = 0;
  std::uint64_t batches = 0;           ///< of all items
  std::uint64_t resumed_batches = 0;   ///< of these, batches from the checkpoint
  bool has_checkpoint = false;         ///< whether this run saved a checkpoint or continued from one
  bool has_all_in_checkpoint = false;  ///< whether it contains all batches
  std::uint64_t rays = 0;              ///< traced in this run, not before it was resumed
  ShadowRays shadow_rays;              ///< of these rays; all 0 without connections of walks from labels
  double seconds = 0;                  ///< of this run
  double seconds_to_halve = 0;         ///< predicted further time to halve the errors
  /// If the required relative error is out of reach (RelativeError::max_samples): this error, the number of
  /// entries that exceed it, the number of these that still would after max_samples, and the worst entries.
  std::optional<double> unmet_error;
  std::uint64_t unmet = 0, out_of_reach = 0;
  std::vector<UnmetEntry> worst_unmet;
  std::array<ErrorQuantiles, 2> errors = {{{0.3}, {0.02}}};
};

}  // namespace shelfbeam
