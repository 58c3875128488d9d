#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Analytic direct light between point labels and point sources, for estimators that do not sample it.
class AnalyticDirect {
 public:
  /// Memory for this world, in bytes.
  static std::size_t bytes(const World& world, const PathRules& rules);

  /// Computes all entries of some labels on the threads of the current arena, or none if `rules` sample
  /// direct light. May end early when cancelled.
  AnalyticDirect(const World& world, const PathRules& rules, std::span<const LabelId> labels,
                 const RunControl& control);
  /// Those of all labels.
  AnalyticDirect(const World& world, const PathRules& rules, const RunControl& control)
      : AnalyticDirect(world, rules, all_numbers<LabelId>(world.receivers.size()), control) {}

  double straight(std::size_t i, std::size_t j) const { return at(straight_, i, j); }
  double mirrored(std::size_t i, std::size_t j) const { return at(mirrored_, i, j); }
  std::uint64_t rays() const { return rays_; }
  bool is_complete() const { return complete_; }

 private:
  double at(const std::vector<float>& values, std::size_t i, std::size_t j) const {
    return values.empty() ? 0 : static_cast<double>(values[i * columns_ + j]);
  }

  std::uint64_t fill_row(const World& world, std::size_t i);

  std::size_t columns_;
  std::vector<float> straight_, mirrored_;  ///< empty: all 0
  std::uint64_t rays_ = 0;
  bool complete_ = true;
};

}  // namespace shelfbeam::detail
