#include "shelfbeam/placement/greedy.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "shelfbeam/placement/mounts.hpp"

namespace shelfbeam {

namespace {

class Greedy {
 public:
  Greedy(const SignalTable& table, const Question& question)
      : table_(table),
        model_(question.model),
        cost_(greedy_costs(table, question)),
        mounts_(table),
        chosen_(table.columns(), false),
        open_(table.columns(), true) {
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if (table.transceivers[j].installed) choose(j);
    look_at_every_label();
  }

  std::vector<std::uint32_t> run() {
    while (true) {
      const std::vector<double> gain = gains();
      if (unmet_.empty()) break;
      auto best = static_cast<std::uint32_t>(table_.columns());
      double best_ratio = std::numeric_limits<double>::infinity();
      for (std::uint32_t j = 0; j < table_.columns(); ++j) {
        if (!open_[j] || gain[j] <= 0) continue;
        const double ratio = cost_[j] / gain[j];
        if (best == table_.columns() || ratio < best_ratio) {
          best = j;
          best_ratio = ratio;
        }
      }
      if (best < table_.columns())
        choose(best);
      else if (!exchange())
        break;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (chosen_[j]) result.push_back(j);
    return result;
  }

 private:
  /// One option of a mounting point in the place of another.
  struct Exchange {
    std::uint32_t out = 0, in = 0;
    double lacking = 0;  ///< what that adds to the shares of their requirements that all labels lack
  };

  void choose(std::uint32_t column) {
    chosen_[column] = true;
    open_[column] = false;
    for (const std::uint32_t option : mounts_.options(column)) open_[option] = false;
  }

  void look_at_every_label() {
    unmet_.resize(table_.rows());
    std::iota(unmet_.begin(), unmet_.end(), std::size_t{0});
  }

  // What one entry is to a label's requirement: a share of it, or all or nothing where one unit must do.
  double share(const SignalEntry& entry, double requirement) const {
    if (model_ == CommunicationModel::cooperative) return entry.signal / requirement;
    return is_met(entry.signal, requirement) ? 1 : 0;
  }

  std::vector<Exchange> exchanges() const {
    std::vector<Exchange> result;
    for (std::uint32_t j = 0; j < table_.columns(); ++j) {
      if (!chosen_[j] || table_.transceivers[j].installed) continue;
      for (const std::uint32_t option : mounts_.options(j))
        if (option != j) result.push_back({j, option, 0});
    }
    return result;
  }

  // Makes the exchange that helps most; false where none helps.
  bool exchange() {
    constexpr double least_help = 1e-9;  // keeps rounding from exchanging to and fro
    const auto lacking = [](double shares) { return is_met(shares, 1) ? 0 : 1 - shares; };
    std::vector<Exchange> all = exchanges();
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      const double requirement = requirement_of(table_.labels[i], model_);
      std::vector<double> part(table_.columns(), 0.0);
      double sum = 0;
      for (const SignalEntry& entry : table_.row(i)) {
        part[entry.transceiver] = share(entry, requirement);
        if (chosen_[entry.transceiver]) sum += part[entry.transceiver];
      }
      for (Exchange& one : all) one.lacking += lacking(sum - part[one.out] + part[one.in]) - lacking(sum);
    }
    const auto best = std::min_element(
        all.begin(), all.end(), [](const Exchange& a, const Exchange& b) { return a.lacking < b.lacking; });
    if (best == all.end() || best->lacking > -least_help) return false;
    chosen_[best->out] = false;
    chosen_[best->in] = true;
    look_at_every_label();
    return true;
  }

  // The gain of every column; drops the labels that are met by now.
  std::vector<double> gains() {
    std::vector<double> gain(table_.columns(), 0.0);
    std::erase_if(unmet_, [&](std::size_t i) {
      const double requirement = requirement_of(table_.labels[i], model_);
      const double received = received_signal(table_, i, chosen_, model_);
      if (is_met(received, requirement)) return true;
      const double lacking = model_ == CommunicationModel::cooperative ? 1 - received / requirement : 1;
      for (const SignalEntry& entry : table_.row(i))
        gain[entry.transceiver] += std::min(lacking, share(entry, requirement));
      return false;
    });
    return gain;
  }

  const SignalTable& table_;
  CommunicationModel model_;
  std::vector<double> cost_;
  Mounts mounts_;
  std::vector<bool> chosen_;
  std::vector<bool> open_;  ///< neither chosen nor at a point that is taken
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
