#include "shelfbeam/placement/bound/cover_cuts.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double min_violation = 1e-3;
constexpr double min_lack = 1e-3;  // BoundRowReader returns no row below
constexpr double min_x = 1e-9;

struct Cut {
  BoundRow row;
  double violation = 0;
};

struct Term {
  std::uint32_t column = 0;
  double a = 0;
  double x = 0;
};

std::vector<Term> terms_of(std::uint32_t label, const CoverRows& cover, std::span<const double> x) {
  std::vector<Term> terms;
  cover.for_entries(label, [&](std::uint32_t j, double a) {
    if (x[j] > min_x) terms.push_back({j, a, x[j]});
  });
  return terms;
}

Cut best_cover(std::uint32_t label, const CoverRows& cover, std::span<const double> x) {
  std::vector<Term> terms = terms_of(label, cover, x);
  std::sort(terms.begin(), terms.end(),
            [](const Term& s, const Term& t) { return s.x != t.x ? s.x > t.x : s.column < t.column; });
  Cut best{{label, {}, 0}, 0};
  std::size_t taken = 0;
  double lacking = cover.bound(label);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    lacking -= terms[k].a;
    if (lacking < 2 * min_lack) break;
    double sum = 0;
    for (std::size_t l = k + 1; l < terms.size(); ++l)
      sum += std::min(1.0, terms[l].a / lacking) * terms[l].x;
    if (1 - sum <= best.violation) continue;
    best.violation = 1 - sum;
    taken = k + 1;
  }
  for (std::size_t k = 0; k < taken; ++k) best.row.taken.push_back(terms[k].column);
  std::sort(best.row.taken.begin(), best.row.taken.end());
  return best;
}

Cut best_share(std::uint32_t label, const CoverRows& cover, std::span<const double> x,
               std::size_t max_units) {
  constexpr int shares = 24;
  const std::vector<Term> terms = terms_of(label, cover, x);
  const double bound = cover.bound(label);
  const auto units = static_cast<double>(max_units);
  Cut best{{label, {}, 0}, 0};
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

template <class Separate>
std::vector<BoundRow> max_violated(std::span<const std::uint32_t> labels, std::size_t max_cuts,
                                   Separate separate) {
  std::vector<Cut> cuts(labels.size());
  parallel_for_ranges(labels.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) cuts[k] = separate(labels[k]);
  });
  std::erase_if(cuts, [](const Cut& cut) { return cut.violation < min_violation; });
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const Cut& a, const Cut& b) { return a.violation > b.violation; });
  cuts.resize(std::min(cuts.size(), max_cuts));
  std::vector<BoundRow> rows;
  rows.reserve(cuts.size());
  for (Cut& cut : cuts) rows.push_back(std::move(cut.row));
  return rows;
}

}  // namespace

std::vector<BoundRow> cover_cuts(const Instance& instance, std::span<const std::uint32_t> labels,
                                 std::span<const double> x, std::size_t max_cuts) {
  const CoverRows cover(instance);
  return max_violated(labels, max_cuts, [&](std::uint32_t label) { return best_cover(label, cover, x); });
}

std::vector<BoundRow> share_cuts(const Instance& instance, std::size_t max_units,
                                 std::span<const std::uint32_t> labels, std::span<const double> x,
                                 std::size_t max_cuts) {
  if (max_units == 0) return {};
  const CoverRows cover(instance, max_units);
  return max_violated(labels, max_cuts,
                      [&](std::uint32_t label) { return best_share(label, cover, x, max_units); });
}

}  // namespace shelfbeam::detail
