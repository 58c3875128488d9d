#pragma once

#include <optional>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam::detail {

/// Of a judge on the log of a search.
enum class ProofVerdict {
  holds,
  left_open,    ///< the log has open nodes or is incomplete
  unfinished,   ///< a limit came first
  unconfirmed,  ///< the log does not hold, which rounding may explain
  refuted
};

/// The strength of the bound that the log proves; nothing if it is refuted.
inline std::optional<BoundProof> strength_of(ProofVerdict verdict) {
  if (verdict == ProofVerdict::refuted) return std::nullopt;
  return verdict == ProofVerdict::holds ? BoundProof::log : BoundProof::search;
}

}  // namespace shelfbeam::detail
