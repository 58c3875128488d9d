#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Verifies units that hang already, all transceivers of the scene, in rounds as `certify` does, until every
/// label is reached or missed: the certificate says nothing of a bound.
/// Which links must do where units do not cooperate is decided on a simulation of its own, as the options
/// say. Throws as `simulate`.
CertifiedPlan verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                                  const RunControl& control = {});

}  // namespace shelfbeam
