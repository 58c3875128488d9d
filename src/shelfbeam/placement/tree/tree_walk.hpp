#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/placement/tree/proof.hpp"
#include "shelfbeam/placement/tree/surrogate.hpp"
#include "shelfbeam/placement/tree/tree_run.hpp"

namespace shelfbeam::detail {

/// The part of a proof that one walk writes. Empty if no proof is requested; a single open node if it grows
/// too long to verify.
class ProofLog {
 public:
  /// `number` distinguishes this walk's weights from those of others.
  ProofLog(TreeRun& run, std::uint32_t number) : run_(run), number_(number), logs_(run.limits.wants_proof) {}

  void add(std::uint32_t word) {
    if (logs_) steps_.push_back(word);
  }
  /// A step with the node's weights, which are stored if they are new.
  void add_weighing(TreeNode& node, Proof::Tag tag, float price);
  /// The head of a branch; the children follow, each after its column.
  void add_branch(LabelId row, bool by_cost, std::span<const ColumnId> columns);
  void move_to(Proof& proof);

 private:
  void give_up();

  TreeRun& run_;
  std::uint32_t number_;
  bool logs_;
  std::vector<std::uint32_t> steps_;
  std::vector<std::vector<float>> weights_;
};

/// A depth-first walk below one node.
class TreeWalk {
 public:
  /// `number` distinguishes its weights in the proof from those of other walks; 0 for the root.
  TreeWalk(TreeRun& run, std::span<const float> weights, std::uint32_t number);

  /// Walks from the root; its children run on all threads.
  void from_root();

  /// Moves steps and weights of this walk and the walks below it.
  void move_log_to(Proof& proof);
  /// Final weights of the root, one per row of the search's matrix.
  const std::vector<float>& weights() const { return nodes_.front().weight; }

 private:
  void visit(std::size_t depth);
  void visit_children(std::size_t depth);
  void children_in_parallel();
  void add_child(TreeRun& run, ColumnId column);
  bool enter(std::size_t depth);
  void complete(std::size_t depth);
  void take_last(std::size_t depth);
  bool may_complete(std::size_t depth);
  void choose_branch(std::size_t depth);
  void branch_on(std::size_t depth, LabelId row, double least);
  void make_child(const TreeNode& parent, ColumnId column, TreeNode& child) const {
    child.take(parent, column, run_.rule, run_.instance.excludes[column]);
  }

  std::size_t units_left(std::size_t depth) const { return max_units_ - depth; }

  TreeRun& run_;
  ProofLog log_;
  SurrogateTest surrogate_;
  std::size_t max_units_;  ///< besides the installed units
  std::vector<ColumnId> chosen_;
  std::int64_t spent_ = 0;
  std::vector<TreeNode> nodes_;  ///< by depth
  std::vector<float> memory_;
  std::vector<std::unique_ptr<TreeWalk>> children_;  ///< of the root
  std::vector<ColumnId> columns_of_children_;
};

}  // namespace shelfbeam::detail
