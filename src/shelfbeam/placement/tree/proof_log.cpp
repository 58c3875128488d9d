#include "shelfbeam/placement/tree/proof_log.hpp"

#include <bit>
#include <utility>

namespace shelfbeam::detail {

void ProofLog::add_weighing(TreeNode& node, Proof::Tag tag, float price) {
  if (!logs_) return;
  constexpr std::size_t most = 1 << 16;
  if (node.weights_id == TreeNode::unlogged) {
    if (weights_.size() == most || !run_.may_log(run_.matrix.rows())) return give_up();
    node.weights_id = number_ << 16 | static_cast<std::uint32_t>(weights_.size());
    std::vector<float>& whole = weights_.emplace_back(run_.matrix.rows(), 0.0F);
    for (std::size_t i = 0; i < node.window->rows.size(); ++i) whole[node.window->rows[i]] = node.weight[i];
  }
  add(tag);
  add(node.weights_id);
  add(std::bit_cast<std::uint32_t>(price));
}

void ProofLog::add_branch(std::uint32_t row, bool by_cost, std::span<const std::uint32_t> columns) {
  add(Proof::branch);
  add(row);
  add(by_cost ? 1 : 0);
  add(static_cast<std::uint32_t>(columns.size()));
  if (logs_ && !run_.may_log(2 * columns.size())) give_up();
}

void ProofLog::move_to(Proof& proof) {
  if (proof.weights.size() <= number_) proof.weights.resize(number_ + 1);
  proof.weights[number_] = std::move(weights_);
  proof.steps.insert(proof.steps.end(), steps_.begin(), steps_.end());
}

void ProofLog::give_up() {
  logs_ = false;
  steps_.assign(1, Proof::open);
}

}  // namespace shelfbeam::detail
