#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/placement/tree/proof_log.hpp"
#include "shelfbeam/placement/tree/surrogate.hpp"
#include "shelfbeam/placement/tree/tree_node.hpp"
#include "shelfbeam/placement/tree/tree_run.hpp"

namespace shelfbeam::detail {

/// One depth-first walk below a node.
class TreeWalk {
 public:
  /// `number` tells its weights in the proof from those of other walks; 0 for the root.
  TreeWalk(TreeRun& run, std::span<const float> weights, std::uint32_t number);

  /// From the root, its children on all threads.
  void from_root();

  /// Steps and weights of this walk and those below it.
  void move_log_to(Proof& proof);
  /// With which the root was left, one a row of the search's matrix.
  const std::vector<float>& weights() const { return nodes_.front().weight; }

 private:
  void visit(std::size_t depth);
  void visit_children(std::size_t depth);
  void children_in_parallel();
  void add_child(TreeRun& run, std::uint32_t column);
  bool enter(std::size_t depth);
  void complete(std::size_t depth);
  void take_last(std::size_t depth);
  bool may_complete(std::size_t depth);
  void choose_branch(std::size_t depth);
  void branch_on(std::size_t depth, std::uint32_t row, double least);
  void make_child(const TreeNode& parent, std::uint32_t column, TreeNode& child) const {
    child.take(parent, column, run_.rule, run_.problem.excludes[column]);
  }

  std::size_t units_left(std::size_t depth) const { return most_units_ - depth; }

  TreeRun& run_;
  ProofLog log_;
  SurrogateTest surrogate_;
  std::size_t most_units_;  ///< beside those that every selection holds
  std::vector<std::uint32_t> chosen_;
  std::int64_t spent_ = 0;
  std::vector<TreeNode> nodes_;  ///< by depth
  std::vector<float> memory_;
  std::vector<std::unique_ptr<TreeWalk>> children_;  ///< of the root, with the columns that they take
  std::vector<std::uint32_t> columns_of_children_;
};

}  // namespace shelfbeam::detail
