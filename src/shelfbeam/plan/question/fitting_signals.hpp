#pragma once

#include <variant>

#include "shelfbeam/plan/answer/given_signals.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// The signals of a scene from those of a matrix with the same light_hash, which may have further labels and
/// transceivers, other names, prices and requirements (light_keys). Entries keep their bytes. A matrix
/// without light_hash fits the scene of its store only. `wanted`: of the simulation that they replace; it
/// would find the same kinds of light. Strategies and estimators may differ otherwise.
std::variant<SignalMatrix, MisfitReason> fitting_signals(StoredSignals signals, const Scene& scene,
                                                         const PathRules& wanted);

}  // namespace shelfbeam
