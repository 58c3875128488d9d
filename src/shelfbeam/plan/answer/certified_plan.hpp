#pragma once

#include <optional>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/reach_curve.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"

namespace shelfbeam {

/// A placement, with what a plan knows of it beyond the matrix that it was made on. It is what placement.json
/// holds.
struct CertifiedPlan {
  Placement placement;
  ReachCurve curve = {};                        ///< without points unless asked for
  std::optional<Certificate> certificate = {};  ///< from fresh samples
  std::optional<Sensitivity> sensitivity = {};  ///< where surfaces reflect less or more
};

}  // namespace shelfbeam
