#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam {

/// Unbiased signals of units, batch by batch: path reuse with the light of the operator's cells as control
/// variate. Units share the paths of the labels, so several together take little longer than one. Works on
/// the threads of the current arena; the results are the same for any number of them.
class UnitRefinement {
 public:
  /// Throws Interrupted when cancelled. The operator must outlive the object.
  UnitRefinement(const LightOperator& light, const std::vector<Transceiver>& units, std::uint64_t seed,
                 const RunControl& control = {});
  UnitRefinement(const LightOperator& light, const Transceiver& unit, std::uint64_t seed,
                 const RunControl& control = {})
      : UnitRefinement(light, std::vector<Transceiver>{unit}, seed, control) {}

  /// Adds batches to each cluster with labels that have a standard error above `target` times their
  /// requirement, or too few batches to tell. `wanted`: by label, those that count; all if it is empty.
  /// Returns the number of these clusters, 0 when all are precise enough. When cancelled, earlier batches
  /// stay.
  std::size_t add(std::uint32_t batches, double target, const RunControl& control = {},
                  const std::vector<std::uint8_t>& wanted = {});

  /// Batches of the least and most refined cluster.
  std::uint32_t fewest_batches() const;
  std::uint32_t most_batches() const;
  std::uint32_t batches(std::size_t label) const { return sums_[item_of_[label]].batches; }
  /// Whether a label has the two batches that its signals and standard errors need.
  bool has_value(std::size_t label) const { return batches(label) >= 2; }
  /// Whether the batches are so skewed that the standard error is not reliable.
  bool is_skewed(std::size_t label, std::size_t unit = 0) const { return is_skewed_[at(label, unit)] != 0; }
  float signal(std::size_t label, std::size_t unit = 0) const { return signal_[at(label, unit)]; }
  float standard_error(std::size_t label, std::size_t unit = 0) const { return error_[at(label, unit)]; }
  /// Replaces the preview of a unit at a label. Precondition: has_value.
  void fill(std::size_t label, std::size_t unit, Preview& preview) const;
  /// The same where there are values.
  void fill(std::size_t unit, Preview& preview) const;

 private:
  bool is_open(std::size_t item, double target, const std::vector<std::uint8_t>& wanted) const;
  void evaluate(std::size_t item);
  std::size_t units() const { return probe_.scene.transceivers.size(); }
  std::size_t at(std::size_t label, std::size_t unit) const { return label * units() + unit; }

  World probe_;
  ReuseEstimator estimator_;
  detail::AnalyticDirect direct_;
  std::vector<ItemSums> sums_;
  std::vector<std::uint32_t> item_of_;  // by label
  std::vector<float> signal_, error_;   // by label and unit
  std::vector<std::uint8_t> is_skewed_;
};

}  // namespace shelfbeam
