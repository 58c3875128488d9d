#pragma once

#include "system/claims/sentences.hpp"

// Conditions of claims.
namespace shelfbeam::test {

using T = const Truth&;
using enum Subject;

inline bool is(T t, const char* name) {
  return t(name) != 0;
}

inline auto holds(const char* name) {
  return [name](T t) { return is(t, name); };
}
inline auto fails(const char* name) {
  return [name](T t) { return !is(t, name); };
}

/// Texts of the terminal, lines of the facts, cells of the alternatives, and sentences about states.
std::vector<Claim> claims_of_lists();

}  // namespace shelfbeam::test
