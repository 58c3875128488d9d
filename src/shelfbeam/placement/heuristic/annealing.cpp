#include <span>
#include <vector>

#include "shelfbeam/placement/heuristic/annealing_walk.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/kernels/active_rows.hpp"

namespace shelfbeam::detail {

namespace {

// The rows of a table that walks work on.
class TableRows : public TotalLack<TableRows> {
 public:
  static constexpr std::uint64_t max_moves = 4096;

  TableRows(const Instance& instance, const SearchMatrix& all, const Selection& start)
      : instance_(instance), all_(all), rows_(all, receiving(instance.problem)) {
    rows_.add_hardest(start, ActiveRows::at_first);
  }

  const ActiveRows& matrix() const { return rows_; }
  bool reaches_all(const Selection& selected) {
    margin_ = margin_of(instance_, all_, selected, received_);
    return margin_.is_met;
  }
  bool add_missed() { return rows_.add_missed(std::span(received_).first(all_.rows()), margin_.label); }

 private:
  const Instance& instance_;
  const SearchMatrix& all_;
  ActiveRows rows_;
  std::vector<float> received_;
  Margin margin_;
};

}  // namespace

bool can_anneal(const PlacementProblem& problem) {
  return problem.combination == Combination::lexicographic;
}

std::optional<Selection> anneal(const Instance& instance, const SearchMatrix& all, const Selection& start,
                                const Effort& effort, std::uint32_t seed, const RunControl& control) {
  if (!can_anneal(instance.problem)) return std::nullopt;
  return best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    return AnnealingWalk(instance, all, TableRows(instance, all, start), start, own_seed);
  });
}

}  // namespace shelfbeam::detail
