#include "shelfbeam/placement/coverage/coverage_search.hpp"

#include <algorithm>
#include <random>

#include "shelfbeam/math/random.hpp"

namespace shelfbeam::detail {

CoverageSearch::CoverageSearch(const SignalTable& table, const PlacementProblem& problem,
                               const LabelWeights& weights)
    : table_(table),
      problem_(problem),
      weights_(weights),
      mounts_(table),
      chosen_(table.columns(), false),
      blocked_by_(table.columns(), 0),
      shares_(table.rows()) {
  for (const SignalTable::Label& label : table.labels)
    requirement_.push_back(requirement_of(label, problem.model));
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) choose(j, true);
  look();
}

void CoverageSearch::start(const std::vector<std::uint32_t>& selected) {
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (chosen_[j]) choose(j, false);
  for (const std::uint32_t j : selected) choose(j, true);
  look();
}

void CoverageSearch::choose(std::uint32_t column, bool chosen) {
  chosen_[column] = chosen;
  count_ += chosen ? 1 : std::size_t(-1);
  mounts_.for_each_conflict(column, [&](std::uint32_t other) { blocked_by_[other] += chosen ? 1U : ~0U; });
}

// Recomputes the shares of every label from the chosen units.
void CoverageSearch::look() {
  reached_ = 0;
  lacks_ = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i] = {};
    for (const SignalEntry& entry : table_.row(i))
      if (chosen_[entry.transceiver]) shares_[i].add(entry.transceiver, share(i, entry));
    const double lack = detail::lacking(shares_[i].sum, shares_[i].largest, problem_);
    reached_ += lack == 0 ? weights_[i] : 0;
    lacks_ += weights_[i] * lack;
  }
  work_ += table_.entries.size();
}

// Gains of every column for the selection, or for the selection without one unit.
CoverageSearch::Gains CoverageSearch::gains(std::optional<std::uint32_t> without) {
  Gains result{std::vector<double>(chosen_.size(), 0.0), std::vector<double>(chosen_.size(), 0.0)};
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
    const double lack = detail::lacking(sum, largest, problem_);
    result.lacks += weights_[i] * lack;
    if (lack == 0) {
      result.reached += weights_[i];
      continue;
    }
    work_ += row.size();
    for (const SignalEntry& entry : row) {
      const double part = share(i, entry);
      const double left = detail::lacking(sum + part, std::max(largest, part), problem_);
      result.lacking[entry.transceiver] += weights_[i] * (lack - left);
      if (left == 0) result.weight[entry.transceiver] += weights_[i];
    }
  }
  return result;
}

std::optional<CoverageSearch::Choice> CoverageSearch::best(const Gains& gains,
                                                           std::optional<std::uint32_t> without,
                                                           Aim aim) const {
  std::vector<bool> freed(chosen_.size(), false);
  if (without) mounts_.for_each_conflict(*without, [&](std::uint32_t j) { freed[j] = blocked_by_[j] == 1; });
  std::optional<Choice> best;
  for (std::uint32_t j = 0; j < chosen_.size(); ++j) {
    if (chosen_[j] || (blocked_by_[j] > 0 && !freed[j]) || gains.lacking[j] <= 0) continue;
    const Choice one{j, gains.weight[j], gains.lacking[j]};
    const bool better =
        !best || (aim == Aim::weight && one.weight != best->weight ? one.weight > best->weight
                                                                   : one.lacking > best->lacking);
    if (better) best = one;
  }
  return best;
}

bool CoverageSearch::drop() {
  std::vector<double> missed(chosen_.size(), 0.0), lost(chosen_.size(), 0.0);
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const double before = detail::lacking(shares_[i].sum, shares_[i].largest, problem_);
    for (const SignalEntry& entry : table_.row(i)) {
      const std::uint32_t j = entry.transceiver;
      if (!chosen_[j]) continue;
      const double after = detail::lacking(std::max(0.0, shares_[i].sum - share(i, entry)),
                                           shares_[i].largest_without(j), problem_);
      lost[j] += weights_[i] * (after - before);
      if (before == 0 && after > 0) missed[j] += weights_[i];
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

// Exchanges `out` for the best other unit if that reaches more weight, or as much with less lack.
bool CoverageSearch::exchange(std::uint32_t out) {
  constexpr double min_help = 1e-9;  // keeps rounding from causing endless exchanges
  const Gains without = gains(out);
  const auto choice = best(without, out, Aim::weight);
  if (!choice) return false;
  const double then = without.reached + choice->weight;
  const bool better =
      then > reached_ || (then == reached_ && without.lacks - choice->lacking < lacks_ - min_help);
  if (!better) return false;
  const std::vector<std::uint32_t> before = selected();
  const double reached_before = reached_, lacks_before = lacks_;
  choose(out, false);
  choose(choice->column, true);
  look();
  if (reached_ > reached_before || (reached_ == reached_before && lacks_ < lacks_before)) return true;
  start(before);  // an improvement only by rounding
  return false;
}

void CoverageSearch::improve(std::size_t max_units, std::size_t work, const RunControl& control,
                             std::chrono::steady_clock::time_point until) {
  const std::size_t end = work_ + work;
  const auto may_continue = [&] {
    return work_ < end && !control.cancelled() && std::chrono::steady_clock::now() < until;
  };
  bool better = true;
  while (better && may_continue()) {
    better = false;
    while (count_ < max_units && may_continue()) {
      const double before = reached_;
      const std::vector<std::uint32_t> kept = selected();
      const auto choice = best(gains({}), {}, count_ + 1 == max_units ? Aim::weight : Aim::deficit);
      if (!choice) break;
      choose(choice->column, true);
      look();
      if (count_ == max_units && reached_ == before) {
        start(kept);
        break;
      }
      better = true;
    }
    for (const std::uint32_t j : selected())
      if (!table_.transceivers[j].installed && chosen_[j] && may_continue() && exchange(j)) better = true;
  }
  while (true) {
    const std::vector<std::uint32_t> before = selected();
    const double reached = reached_;
    if (!drop()) return;
    if (reached_ < reached) return start(before);
  }
}

void CoverageSearch::improve_repeatedly(std::size_t max_units, std::size_t work, const RunControl& control,
                                        std::chrono::steady_clock::time_point until) {
  constexpr std::size_t work_of_repetitions = 200'000'000;  // about a second
  constexpr std::uint64_t repetitions = 200;
  std::size_t end = work_ + work;
  improve(max_units, work, control, until);
  end = std::min(end, work_ + work_of_repetitions);
  for (std::uint64_t repetition = 1; repetition <= repetitions; ++repetition) {
    if (reached_ >= weights_.total() || work_ >= end || control.cancelled() ||
        std::chrono::steady_clock::now() >= until)
      return;
    const std::vector<std::uint32_t> before = selected();
    const double reached = reached_, lacks = lacks_;
    remove_some(repetition);
    improve(max_units, end - work_, control, until);
    if (reached_ < reached || (reached_ == reached && lacks_ > lacks)) start(before);
  }
}

void CoverageSearch::remove_some(std::uint64_t repetition) {
  constexpr std::uint64_t own_key = 0x636f766572;
  constexpr std::size_t units = 2;
  std::mt19937_64 random(mix_key(own_key, repetition));
  for (std::size_t k = 0; k < units; ++k) {
    std::vector<std::uint32_t> free;
    for (const std::uint32_t j : selected())
      if (!table_.transceivers[j].installed) free.push_back(j);
    if (!free.empty()) choose(free[random() % free.size()], false);
  }
  look();
}

std::vector<std::uint32_t> CoverageSearch::selected() const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (chosen_[j]) result.push_back(j);
  return result;
}

}  // namespace shelfbeam::detail
