#pragma once

#include <limits>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/refutation.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"

namespace shelfbeam {

struct TestedRefutation {
  /// The leaves that are not refuted at the level of the test. Only these need another test: a selection is
  /// in one leaf, so the levels of all tests of this leaf add up to a bound on the probability of an error.
  std::vector<Refutation::Leaf> open;
  /// If splitting the open leaves would take long: the batches that are likely to refute them with their own
  /// weights. Infinity if these are more than four times the batches of the test.
  double needed = std::numeric_limits<double>::infinity();
  std::vector<ValidationRow> fresh;  ///< the batches of the refutation's labels
};

/// Tests a refutation with independent batches of its labels (`request.labels` is ignored). If a selection S*
/// of the budget reaches all labels, its leaf is refuted with probability at most `level`: the upper limits
/// of its columns then add up to less than 1, although
///
///   sum_{j in S*} (x_j + t SE(x_j)) >= x(S*) + t SE(x(S*)),   x(S*) >= 1,
///
/// so it is enough that each limit has the level of a single statement, for any number of leaves,
/// columns and labels. Limits are those of ValidationEstimate::upper, or larger: a column that was hit rarely
/// also takes the limit of the shortest sum of the columns of no larger `planned` signals that was hit often
/// (a tenth of the level, shared by all columns, is for these sums); a column whose error rests on one to
/// three large batches takes the limit of the probability of this number, at twice the largest value. A leaf
/// has a fifth of the level for four other weights of the tree, those with the smallest planned totals.
/// Takes fewer batches, at least 32, if the deadline passes. Throws as `sample_batches`.
TestedRefutation test_refutation(const PreparedScene& prepared, const Refutation& refutation,
                                 const SignalTable& planned, BatchRequest request, double level,
                                 const Deadline& deadline, const RunControl& control);

}  // namespace shelfbeam
