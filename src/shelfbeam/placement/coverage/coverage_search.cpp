#include "shelfbeam/placement/coverage/reach_search.hpp"

namespace shelfbeam::detail {

ReachSearch::ReachSearch(const SignalTable& table, const Question& question)
    : table_(table),
      question_(question),
      mounts_(table),
      chosen_(table.columns(), false),
      excluded_by_(table.columns(), 0),
      shares_(table.rows()) {
  for (const SignalTable::Label& label : table.labels)
    requirement_.push_back(requirement_of(label, question.model));
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) choose(j, true);
  look();
}

void ReachSearch::start(const std::vector<std::uint32_t>& selected) {
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (chosen_[j]) choose(j, false);
  for (const std::uint32_t j : selected) choose(j, true);
  look();
}

void ReachSearch::choose(std::uint32_t column, bool chosen) {
  chosen_[column] = chosen;
  count_ += chosen ? 1 : std::size_t(-1);
  mounts_.for_each_excluded(column, [&](std::uint32_t other) { excluded_by_[other] += chosen ? 1U : ~0U; });
}

// Computes what every label has from the chosen units.
void ReachSearch::look() {
  reached_ = 0;
  lacks_ = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i] = {};
    for (const SignalEntry& entry : table_.row(i))
      if (chosen_[entry.transceiver]) shares_[i].add(entry.transceiver, share(i, entry));
    const double lack = detail::lacking(shares_[i].sum, shares_[i].largest, question_);
    reached_ += lack == 0 ? 1 : 0;
    lacks_ += lack;
  }
  work_ += table_.entries.size();
}

// What every column would add to the selection, less one unit; and what that is without an addition.
ReachSearch::Gains ReachSearch::gains(std::optional<std::uint32_t> without) {
  Gains result{std::vector<std::size_t>(chosen_.size(), 0), std::vector<double>(chosen_.size(), 0.0)};
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const auto row = table_.row(i);
    double sum = shares_[i].sum, largest = shares_[i].largest;
    if (without) {
      const auto found = std::lower_bound(
          row.begin(), row.end(), *without,
          [](const SignalEntry& entry, std::uint32_t column) { return entry.transceiver < column; });
      if (found != row.end() && found->transceiver == *without) {
        sum = std::max(0.0, sum - share(i, *found));
        largest = shares_[i].largest_without(*without);
      }
    }
    const double lack = detail::lacking(sum, largest, question_);
    result.lacks += lack;
    if (lack == 0) {
      ++result.reached;
      continue;
    }
    work_ += row.size();
    for (const SignalEntry& entry : row) {
      const double part = share(i, entry);
      const double left = detail::lacking(sum + part, std::max(largest, part), question_);
      result.lacking[entry.transceiver] += lack - left;
      if (left == 0) ++result.labels[entry.transceiver];
    }
  }
  return result;
}

std::optional<ReachSearch::Choice> ReachSearch::best(const Gains& gains, std::optional<std::uint32_t> without,
                                                     Aim aim) const {
  std::vector<bool> freed(chosen_.size(), false);
  if (without) mounts_.for_each_excluded(*without, [&](std::uint32_t j) { freed[j] = excluded_by_[j] == 1; });
  std::optional<Choice> best;
  for (std::uint32_t j = 0; j < chosen_.size(); ++j) {
    if (chosen_[j] || (excluded_by_[j] > 0 && !freed[j]) || gains.lacking[j] <= 0) continue;
    const Choice one{j, gains.labels[j], gains.lacking[j]};
    const bool better =
        !best || (aim == Aim::labels && one.labels != best->labels ? one.labels > best->labels
                                                                   : one.lacking > best->lacking);
    if (better) best = one;
  }
  return best;
}

bool ReachSearch::drop() {
  std::vector<std::size_t> missed(chosen_.size(), 0);
  std::vector<double> lost(chosen_.size(), 0.0);
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const double before = detail::lacking(shares_[i].sum, shares_[i].largest, question_);
    for (const SignalEntry& entry : table_.row(i)) {
      const std::uint32_t j = entry.transceiver;
      if (!chosen_[j]) continue;
      const double after = detail::lacking(std::max(0.0, shares_[i].sum - share(i, entry)),
                                           shares_[i].largest_without(j), question_);
      lost[j] += after - before;
      if (before == 0 && after > 0) ++missed[j];
    }
  }
  work_ += table_.entries.size();
  std::optional<std::uint32_t> out;
  for (std::uint32_t j = 0; j < chosen_.size(); ++j) {
    if (!chosen_[j] || table_.transceivers[j].installed) continue;
    if (!out || missed[j] < missed[*out] || (missed[j] == missed[*out] && lost[j] < lost[*out])) out = j;
  }
  if (!out) return false;
  choose(*out, false);
  look();
  return true;
}

// Another unit in the place of this one, where that reaches more labels, or as many with less lacking.
bool ReachSearch::exchange(std::uint32_t out) {
  constexpr double least_help = 1e-9;  // keeps rounding from exchanging to and fro
  const Gains without = gains(out);
  const auto choice = best(without, out, Aim::labels);
  if (!choice) return false;
  const std::size_t then = without.reached + choice->labels;
  const bool better =
      then > reached_ || (then == reached_ && without.lacks - choice->lacking < lacks_ - least_help);
  if (!better) return false;
  const std::vector<std::uint32_t> before = selected();
  const std::size_t reached_before = reached_;
  const double lacks_before = lacks_;
  choose(out, false);
  choose(choice->column, true);
  look();
  if (reached_ > reached_before || (reached_ == reached_before && lacks_ < lacks_before)) return true;
  start(before);  // rounding had it better than it is
  return false;
}

void ReachSearch::improve(std::size_t most_units, std::size_t work, const RunControl& control,
                          std::chrono::steady_clock::time_point until) {
  const std::size_t end = work_ + work;
  const auto goes_on = [&] {
    return work_ < end && !control.cancelled() && std::chrono::steady_clock::now() < until;
  };
  bool better = true;
  while (better && goes_on()) {
    better = false;
    while (count_ < most_units && goes_on()) {
      const std::size_t before = reached_;
      const std::vector<std::uint32_t> kept = selected();
      const auto choice = best(gains({}), {}, count_ + 1 == most_units ? Aim::labels : Aim::what_is_lacking);
      if (!choice) break;
      choose(choice->column, true);
      look();
      if (count_ == most_units && reached_ == before) {
        start(kept);
        break;
      }
      better = true;
    }
    for (const std::uint32_t j : selected())
      if (!table_.transceivers[j].installed && chosen_[j] && goes_on() && exchange(j)) better = true;
  }
  while (true) {
    const std::vector<std::uint32_t> before = selected();
    const std::size_t reached = reached_;
    if (!drop()) return;
    if (reached_ < reached) return start(before);
  }
}

std::vector<std::uint32_t> ReachSearch::selected() const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (chosen_[j]) result.push_back(j);
  return result;
}

}  // namespace shelfbeam::detail
