#include "shelfbeam/placement/greedy.hpp"

#include <algorithm>
#include <limits>

namespace shelfbeam {

namespace {

class Greedy {
 public:
  Greedy(const SignalTable& table, const Question& question)
      : table_(table),
        model_(question.model),
        cost_(greedy_costs(table, question)),
        chosen_(table.columns(), false) {
    for (std::size_t j = 0; j < table.columns(); ++j) chosen_[j] = table.transceivers[j].installed;
    for (std::size_t i = 0; i < table.rows(); ++i) unmet_.push_back(i);
  }

  std::vector<std::uint32_t> run() {
    while (true) {
      const std::vector<double> gain = gains();
      if (unmet_.empty()) break;
      std::size_t best = table_.columns();
      double best_ratio = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < table_.columns(); ++j) {
        if (chosen_[j] || gain[j] <= 0) continue;
        const double ratio = cost_[j] / gain[j];
        if (best == table_.columns() || ratio < best_ratio) {
          best = j;
          best_ratio = ratio;
        }
      }
      if (best == table_.columns()) break;
      chosen_[best] = true;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (chosen_[j]) result.push_back(j);
    return result;
  }

 private:
  // The gain of every column; drops the labels that are met by now.
  std::vector<double> gains() {
    std::vector<double> gain(table_.columns(), 0.0);
    std::erase_if(unmet_, [&](std::size_t i) {
      const double requirement = requirement_of(table_.labels[i], model_);
      const double received = received_signal(table_, i, chosen_, model_);
      if (is_met(received, requirement)) return true;
      const double lacking = 1 - received / requirement;
      for (const SignalEntry& entry : table_.row(i)) {
        if (model_ == CommunicationModel::cooperative)
          gain[entry.transceiver] += std::min(lacking, entry.signal / requirement);
        else if (is_met(entry.signal, requirement))
          gain[entry.transceiver] += 1;
      }
      return false;
    });
    return gain;
  }

  const SignalTable& table_;
  CommunicationModel model_;
  std::vector<double> cost_;
  std::vector<bool> chosen_;
  std::vector<std::size_t> unmet_;
};

}  // namespace

std::vector<double> greedy_costs(const SignalTable& table, const Question& question) {
  std::vector<double> cost = objective_coefficients(table, question);
  for (std::size_t j = 0; j < cost.size(); ++j)
    cost[j] += question.combination == Combination::lexicographic ? 1.0 : table.transceivers[j].cost;
  return cost;
}

std::vector<std::uint32_t> greedy_selection(const SignalTable& table, const Question& question) {
  return Greedy(table, question).run();
}

}  // namespace shelfbeam
