#include "shelfbeam/placement/detail/cover_cuts.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/detail/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double least_violation = 1e-3;
constexpr double least_residual = 1e-3;  // smaller ones divide by next to nothing
constexpr double least_value = 1e-9;     // of x

struct Cut {
  BoundRow row;
  double violation = 0;
};

struct Term {
  std::uint32_t column = 0;
  double a = 0;
  double x = 0;
};

Cut best_cut(std::uint32_t label, const CoverRows& cover, std::span<const double> x) {
  std::vector<Term> terms;
  cover.for_entries(label, [&](std::uint32_t j, double a) {
    if (x[j] > least_value) terms.push_back({j, a, x[j]});
  });
  std::sort(terms.begin(), terms.end(),
            [](const Term& s, const Term& t) { return s.x != t.x ? s.x > t.x : s.column < t.column; });
  Cut best{{label, {}}, least_violation};
  std::size_t taken = 0;
  double residual = cover.bound();
  for (std::size_t k = 0; k < terms.size(); ++k) {
    residual -= terms[k].a;
    if (residual < least_residual) break;
    double sum = 0;
    for (std::size_t l = k + 1; l < terms.size(); ++l)
      sum += std::min(1.0, terms[l].a / residual) * terms[l].x;
    if (1 - sum <= best.violation) continue;
    best.violation = 1 - sum;
    taken = k + 1;
  }
  for (std::size_t k = 0; k < taken; ++k) best.row.taken.push_back(terms[k].column);
  std::sort(best.row.taken.begin(), best.row.taken.end());
  return best;
}

}  // namespace

std::vector<BoundRow> cover_cuts(const SignalTable& table, const Question& question,
                                 std::span<const std::uint32_t> labels, std::span<const double> x,
                                 std::size_t most) {
  const CoverRows cover(table, question.model);
  std::vector<Cut> cuts(labels.size());
  for_parts(labels.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) cuts[k] = best_cut(labels[k], cover, x);
  });
  std::erase_if(cuts, [](const Cut& cut) { return cut.row.taken.empty(); });
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const Cut& a, const Cut& b) { return a.violation > b.violation; });
  cuts.resize(std::min(cuts.size(), most));
  std::vector<BoundRow> rows;
  for (Cut& cut : cuts) rows.push_back(std::move(cut.row));
  return rows;
}

}  // namespace shelfbeam::detail
