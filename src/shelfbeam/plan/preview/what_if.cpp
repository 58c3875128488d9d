#include "shelfbeam/plan/preview/what_if.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

namespace {

// The received signal of a label and its standard error.
class Total {
 public:
  explicit Total(const PlacementProblem& problem)
      : is_sum_(problem.model == CommunicationModel::cooperative),
        redundant_(problem.redundant),
        received_(problem) {}

  void add(double signal, double error) {
    // The error of the part that ReceivedSignal counts.
    double part = signal, of_part = error;
    if (signal > largest_) {
      if (redundant_) {
        part = largest_;
        of_part = of_largest_;
      }
      largest_ = signal;
      of_largest_ = error;
    }
    if (is_sum_)
      squares_ += of_part * of_part;
    else if (part >= received_.value())
      squares_ = of_part * of_part;
    received_.add(signal);
  }
  double signal() const { return received_.value(); }
  double error() const { return std::sqrt(squares_); }

 private:
  bool is_sum_, redundant_;
  ReceivedSignal received_;
  double largest_ = 0, of_largest_ = 0, squares_ = 0;
};

template <class Test>
std::size_t count(const std::vector<LabelWhatIf>& labels, const Test& test) {
  return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), test));
}

}  // namespace

bool is_undecided(double signal, double error, double requirement) {
  constexpr double quantile = 1.96;
  return std::abs(signal - requirement) <= quantile * error;
}

double LabelWhatIf::margin() const {
  return requirement > 0 ? after / requirement : std::numeric_limits<double>::infinity();
}

std::size_t WhatIf::reached() const {
  return count(labels, [](const LabelWhatIf& label) { return label.is_reached(); });
}
std::size_t WhatIf::gained() const {
  return count(labels, [](const LabelWhatIf& label) { return label.is_reached() && !label.was_reached(); });
}
std::size_t WhatIf::lost() const {
  return count(labels, [](const LabelWhatIf& label) { return !label.is_reached() && label.was_reached(); });
}
std::size_t WhatIf::close() const {
  return count(labels, [](const LabelWhatIf& label) { return label.is_close(); });
}
std::size_t WhatIf::doubtful() const {
  return count(labels, [](const LabelWhatIf& label) { return label.doubts != 0; });
}
std::vector<LabelId> WhatIf::weakest() const {
  return ordered_by<LabelId>(labels.size(), [&](LabelId i) { return labels[i].margin(); });
}

std::vector<std::uint32_t> kept_units(const std::optional<UnitsBefore>& before,
                                      const std::vector<std::string>& removed) {
  std::vector<std::uint32_t> kept = all_numbers(before ? before->ids.size() : 0);
  for (const std::string& id : removed) {
    const auto found =
        std::find_if(kept.begin(), kept.end(), [&](std::uint32_t k) { return before->ids[k] == id; });
    if (found == kept.end())
      throw InputError(fmt::format("unit {}", in_quotes(id)), "is not among the mounted units",
                       "name a unit that the plan mounts or, without a plan, that the store selects, once");
    kept.erase(found);
  }
  return kept;
}

WhatIf what_if(const Scene& scene, const std::optional<UnitsBefore>& before, WhatIf change,
               std::span<const Preview> added) {
  change.has_before = before.has_value();
  if (before) change.problem = before->problem;
  const std::vector<std::uint32_t> kept = kept_units(before, change.removed);
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    LabelWhatIf label{.requirement = scene.requirement_of(scene.labels[i])};
    Total first(change.problem), after(change.problem);
    const auto add = [i](const Preview& unit, Total& total) {
      total.add(static_cast<double>(unit.signal[i]), static_cast<double>(unit.error[i]));
    };
    const auto add_after = [&](const Preview& unit) {
      add(unit, after);
      label.doubts |= unit.doubts[i];
    };
    if (before)
      for (const Preview& unit : before->columns) add(unit, first);
    for (const std::uint32_t k : kept) add_after(before->columns[k]);
    for (const Preview& unit : added) add_after(unit);
    label.before = first.signal();
    label.after = after.signal();
    label.error = after.error();
    change.labels.push_back(label);
  }
  return change;
}

}  // namespace shelfbeam
