#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/decisive_value.hpp"
#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/alternatives.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"

namespace shelfbeam {

/// A placement with the further results of a plan; the content of placement.json.
struct CertifiedPlan {
  Placement placement;
  Alternatives alternatives = {};                 ///< empty unless requested
  CoverageCurve curve = {};                       ///< without points unless requested
  std::optional<Certificate> certificate = {};    ///< from independent samples
  std::optional<Availability> availability = {};  ///< of a shop that changes; then there is no certificate
  std::optional<Sensitivity> sensitivity = {};    ///< to reflectances
  std::vector<Finding> warnings = {};             ///< about implausible values and results
  /// Of the random numbers of the plan; its signals may have another (Provenance). Nothing for a placement
  /// alone, and for plans up to version 0.3, whose signals have the same.
  std::optional<std::uint64_t> seed = {};
  /// The values on which the plan rests; empty up to version 0.4, whose values count as given.
  std::vector<DecisiveValue> values = {};
  bool is_example = false;  ///< the store says that its values are invented

  /// Independent samples have verified at least one label.
  bool has_verdicts() const { return certificate && !certificate->none_verified(); }
  /// The same or, for a shop that changes, fresh states have been examined.
  bool is_verified() const { return availability ? availability->has_answer() : has_verdicts(); }

  /// The state of the value that is known least.
  ValueState weakest_state() const {
    if (values.empty()) return ValueState::given;
    return std::ranges::min(values, {}, &DecisiveValue::state).state;
  }
  /// No threshold is assumed, so that a reserve has a meaning.
  bool has_known_thresholds() const {
    return std::ranges::none_of(values, [](const DecisiveValue& value) {
      return value.kind == ValueKind::threshold && value.state == ValueState::assumed;
    });
  }
};

}  // namespace shelfbeam
