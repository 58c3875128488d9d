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

/// What makes two things the same that agree in one respect only.
enum class SameBy {
  value,  ///< a unit that stays in its place has another id
  id      ///< labels of a moved fixture are in the places of others
};

/// Pairs things in three passes: equal ids and values, equal in the respect `first`, equal in the other one.
/// In the order of `after`, then of `before`. Among equals, earlier ones are paired first.
std::vector<Match> matches(const std::vector<Identity>& before, const std::vector<Identity>& after,
                           SameBy first);

}  // namespace shelfbeam
