#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"

namespace shelfbeam {

/// Previews of the signals of all candidates of a scene, with their errors: a matrix for a first placement,
/// which a simulation must confirm. Works on the threads of the current arena; the result is the same for
/// any number of threads. Throws Interrupted when cancelled.
SignalMatrix preview_matrix(const Scene& scene, const LightOperator& light, std::uint64_t seed,
                            const RunControl& control = {});

}  // namespace shelfbeam
