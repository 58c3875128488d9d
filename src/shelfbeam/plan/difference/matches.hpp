#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shelfbeam {

/// A thing of one of two lists. The value is the text of all that makes it the same thing under another id.
struct Identity {
  std::string id, value;
};

/// The same thing in both lists, or a thing that one of them lacks; indices.
struct Match {
  std::optional<std::uint32_t> before, after;
};

/// Pairs the things with equal ids and values, then those with equal values, then those with equal ids. In
/// the order of `after`, then of `before`. Among equals, earlier ones are paired first.
std::vector<Match> matches(const std::vector<Identity>& before, const std::vector<Identity>& after);

}  // namespace shelfbeam
