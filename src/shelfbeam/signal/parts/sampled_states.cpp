#include "shelfbeam/signal/parts/sampled_states.hpp"

#include <fmt/format.h>

namespace shelfbeam {

SampledStates::SampledStates(std::span<const std::filesystem::path> parts)
    : parts_(detail::open_parts(parts)) {
  StoredSignals first;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const detail::SignalPart& file = parts_[p];
    if (!file.serves_plan()) refuse(file, "has no states for a plan", "simulate states for a plan");
    const StoredSignals part = file.matrix();
    if (p == 0) first = part;
    expect_same(file, part, parts_.front(), first);
    if (part.states->hard.size() != part.rows()) refuse(file, "does not have all labels in its states");
    const auto& members = file.share().members;
    for (std::uint32_t k = 0; k < members.size(); ++k) {
      if (members[k] != places_.size())
        refuse(file, fmt::format("has state {} where state {} is missing", members[k], places_.size()));
      places_.push_back({p, k});
    }
  }
  provenance_ = first.provenance;
  labels_ = first.rows();
  candidates_ = first.columns();
}

void SampledStates::expect(const std::string& store_hash, std::uint64_t seed, std::size_t labels,
                           std::size_t candidates, std::uint32_t states) const {
  const auto differ = [&](const std::string& problem) {
    refuse(parts_.front(), problem, "simulate them for this plan");
  };
  if (provenance_.store_hash != store_hash)
    differ(fmt::format("is of another store: its store hash is '{}' instead of '{}'", provenance_.store_hash,
                       store_hash));
  if (provenance_.seed != seed) differ(fmt::format("has the seed {} instead of {}", provenance_.seed, seed));
  if (labels_ != labels || candidates_ != candidates)
    differ(fmt::format("has {} labels and {} candidates instead of {} and {}", labels_, candidates_, labels,
                       candidates));
  if (count() < states)
    differ(fmt::format("and the other parts have {} states, but the plan needs {}", count(), states));
}

SignalLayer SampledStates::state(std::uint32_t k) const {
  const Place& place = places_[k];
  return parts_[place.part].state(place.state, labels_, candidates_);
}

}  // namespace shelfbeam
