#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The method that gave a result.
enum class Method {
  none,    ///< some labels are unreachable, so no method ran
  search,  ///< local search, tree search or enumeration
  greedy,  ///< the paper's greedy method
  mip,     ///< a MIP back end alone
  states   ///< search over the states of a shop that changes
};

template <>
inline constexpr auto names_of<Method> = std::to_array<Named<Method>>({{"none", Method::none},
                                                                       {"search", Method::search},
                                                                       {"greedy", Method::greedy},
                                                                       {"mip", Method::mip},
                                                                       {"states", Method::states}});

/// A method and the MIP back end that it used.
struct SolvedBy {
  Method method = Method::none;
  std::optional<std::string> backend = {};  ///< name and version: "highs 1.10.0"

  bool operator==(const SolvedBy&) const = default;
};

/// A step of a search, with the value of the incumbent and its bound before and after. A value is infinite if
/// none is known, a bound if no selection exists. If several searches answer a question, the units of measure
/// of their values differ.
struct SearchStep {
  std::string_view name;  ///< of a method, static
  double seconds = 0;     ///< wall time
  double value_before = 0, value = 0;
  double bound_before = 0, bound = 0;
};

}  // namespace shelfbeam
