#include "shelfbeam/placement/bound/share_cuts.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double min_violation = 1e-3;
constexpr double min_x = 1e-9;

struct Cut {
  BoundRow row;
  double violation = 0;
};

struct Term {
  double a = 0;
  double x = 0;
};

std::vector<Term> terms_of(LabelId label, const CoverRows& cover, std::span<const double> x) {
  std::vector<Term> terms;
  cover.for_entries(label, [&](std::uint32_t j, double a) {
    if (x[j] > min_x) terms.push_back({a, x[j]});
  });
  return terms;
}

Cut best_share(LabelId label, const CoverRows& cover, std::span<const double> x, std::size_t max_units) {
  constexpr int shares = 24;
  const std::vector<Term> terms = terms_of(label, cover, x);
  const double bound = cover.bound(label);
  const auto units = static_cast<double>(max_units);
  Cut best{{.label = label}};
  for (int k = 1; k <= shares; ++k) {
    // s K, the contribution of all units below the share, grows evenly up to nearly the whole bound.
    const double below = bound * k / (shares + 0.25);
    const double share = below / units;
    const double lacking = bound - below;
    double sum = 0;
    for (const Term& term : terms)
      if (term.a > share) sum += std::min(1.0, (term.a - share) / lacking) * term.x;
    if (1 - sum <= best.violation) continue;
    best.violation = 1 - sum;
    best.row.share = share;
  }
  return best;
}

}  // namespace

std::vector<BoundRow> share_cuts(const Instance& instance, std::size_t max_units,
                                 std::span<const LabelId> labels, std::span<const double> x,
                                 std::size_t max_cuts) {
  if (max_units == 0) return {};
  const CoverRows cover(instance, max_units);
  std::vector<Cut> cuts(labels.size());
  parallel_for_ranges(labels.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) cuts[k] = best_share(labels[k], cover, x, max_units);
  });
  std::erase_if(cuts, [](const Cut& cut) { return cut.violation < min_violation; });
  std::ranges::stable_sort(cuts, std::greater{}, &Cut::violation);
  std::vector<BoundRow> rows;
  for (const Cut& cut : std::span(cuts).first(std::min(cuts.size(), max_cuts))) rows.push_back(cut.row);
  return rows;
}

}  // namespace shelfbeam::detail
