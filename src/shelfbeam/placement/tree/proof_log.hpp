#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/tree/proof.hpp"
#include "shelfbeam/placement/tree/tree_node.hpp"
#include "shelfbeam/placement/tree/tree_run.hpp"

namespace shelfbeam::detail {

/// What one walk adds to the proof of its search. Empty where none is wanted; a node that is left open where
/// it grows too long to be checked.
class ProofLog {
 public:
  /// `number` tells the weights of this walk from those of others.
  ProofLog(TreeRun& run, std::uint32_t number) : run_(run), number_(number), logs_(run.limits.wants_proof) {}

  void add(std::uint32_t word) {
    if (logs_) steps_.push_back(word);
  }
  /// A step that rests on the node's weights, which are stored where they are new.
  void add_weighing(TreeNode& node, Proof::Tag tag, float price);
  /// The head of a branch; the children follow, each behind its column.
  void add_branch(std::uint32_t row, bool by_cost, std::span<const std::uint32_t> columns);
  void move_to(Proof& proof);

 private:
  void give_up();

  TreeRun& run_;
  std::uint32_t number_;
  bool logs_;
  std::vector<std::uint32_t> steps_;
  std::vector<std::vector<float>> weights_;
};

}  // namespace shelfbeam::detail
