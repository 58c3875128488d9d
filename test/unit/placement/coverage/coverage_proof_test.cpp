#include "shelfbeam/placement/coverage/coverage_proof.hpp"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"

#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam::detail {
namespace {

/// An enumeration of a random question, and another one of all that weighs more, which finds nothing.
struct Question {
  SignalTable table;
  Instance instance;
  LabelWeights weights;
  std::size_t units;
  CoverageEnumeration found, more;

  Question(test::RandomTables& tables, const SignalTable& next)
      : table(next),
        instance(table, tables.next_problem()),
        weights(table),
        units(test::some_units(tables, table)) {
    CoverageTable dense(instance, weights);
    Effort effort;
    found = enumerate_coverage(dense, weights, units, 0, EnumerationAim::best, effort, {});
    more = enumerate_coverage(dense, weights, units, found.weight + weights.step(), EnumerationAim::best,
                              effort, {});
  }
  /// The least weight that an enumeration excludes.
  double excluded(const CoverageEnumeration& by) const {
    return (by.selected ? by.weight : found.weight) + weights.step();
  }
  ProofVerdict judge(const CoverageProof& proof, double needed) const {
    return judge_coverage(instance, weights, proof, units, needed, {}, {});
  }
};

// Every proof holds, but for few that rounding leaves unfinished. Controls: a weight that a selection reaches
// is refuted, and proofs with less are no proofs.
TEST(CoverageProof, IsVerified) {
  test::RandomTables tables(301, test::weighed_tables);
  int proofs = 0, held = 0, refuted = 0, attained = 0, shortened = 0, held_shortened = 0, wrong = 0;
  for (int k = 0; k < 1500; ++k) {
    const Question question(tables, tables.next());
    if (!question.found.is_complete || question.weights.total() == 0) continue;
    const CoverageProof& proof = question.more.proof;
    for (const CoverageEnumeration* const one : {&question.found, &question.more}) {
      const ProofVerdict verdict = question.judge(one->proof, question.excluded(*one));
      ++proofs;
      held += verdict == ProofVerdict::holds;
      refuted += verdict == ProofVerdict::refuted;
    }
    if (!question.found.selected) continue;

    const double too_little = question.found.weight - question.weights.step() / 2;
    ++attained;
    wrong += question.judge(proof, too_little) == ProofVerdict::holds;
    if (proof.steps.size() < 8 || proof.steps.front() != CoverageProof::branch) continue;
    // Without the children of the root, which are listed because the bound does not exclude them.
    CoverageProof childless = proof;
    childless.steps = {proof.steps[0], proof.steps[1], proof.steps[2], CoverageProof::end};
    ++shortened;
    held_shortened += question.judge(childless, question.excluded(question.more)) == ProofVerdict::holds;
  }
  EXPECT_GT(proofs, 2000);
  EXPECT_GT(held, proofs * 99 / 100);
  EXPECT_EQ(refuted, 0);
  EXPECT_GT(attained, 1000);
  EXPECT_EQ(wrong, 0) << "a selection of this weight exists";
  EXPECT_GT(shortened, 100);
  EXPECT_LT(held_shortened, shortened / 2) << "if rounding alone has kept the children";
}

TEST(CoverageProof, OfOtherContentIsRefuted) {
  test::RandomTables tables(302, test::weighed_tables);
  int altered = 0;
  for (int k = 0; k < 300; ++k) {
    const Question question(tables, tables.next());
    const CoverageProof& proof = question.found.proof;
    if (!question.found.is_complete || proof.multipliers.empty() || proof.rows.empty()) continue;
    ++altered;
    CoverageProof other = proof;
    const double needed = question.excluded(question.found);
    other.multipliers[0][0] = 1.5F;
    EXPECT_EQ(question.judge(other, needed), ProofVerdict::refuted) << "a multiplier above 1";
    other = proof;
    other.rows.pop_back();
    for (auto& y : other.multipliers) y.pop_back();
    EXPECT_EQ(question.judge(other, needed), ProofVerdict::refuted) << "a label without a row";
    other = proof;
    other.steps.pop_back();
    EXPECT_NE(question.judge(other, needed), ProofVerdict::holds) << "an end before the last node";
    other = proof;
    other.steps.push_back(CoverageProof::end);
    EXPECT_NE(question.judge(other, needed), ProofVerdict::holds) << "more than the tree";
  }
  EXPECT_GT(altered, 50);
}

}  // namespace
}  // namespace shelfbeam::detail
