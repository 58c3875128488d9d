#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Verifies units that hang already, all transceivers of the scene, in rounds as `certify` does, until every
/// label is reached or missed: the certificate of the placement that is returned says nothing of a bound.
/// Which links must do where units do not cooperate is decided on a simulation of its own, as the options
/// say. Throws as `simulate`.
Placement verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                              const RunControl& control = {});

}  // namespace shelfbeam
