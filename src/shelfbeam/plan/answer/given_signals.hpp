#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The kind of difference between signals and a scene that they do not fit.
enum class Misfit : std::uint8_t {
  states,        ///< they are of a changing shop
  store,         ///< another store, by its hash, in a file without light_hash
  light,         ///< other surfaces, materials or wavelength
  labels,        ///< labels of the scene are missing
  transceivers,  ///< transceivers of the scene are missing
};
template <>
inline constexpr auto names_of<Misfit> =
    std::to_array<Named<Misfit>>({{"states", Misfit::states},
                                  {"store", Misfit::store},
                                  {"light", Misfit::light},
                                  {"labels", Misfit::labels},
                                  {"transceivers", Misfit::transceivers}});

struct MisfitReason {
  Misfit code = Misfit::light;
  std::size_t missing = 0;         ///< number of labels or transceivers
  std::string first_missing = {};  ///< id of one of them
};

/// Signals that another run has simulated.
struct ReusedSignals {
  std::size_t labels = 0, transceivers = 0;  ///< numbers in the file, which may have more than the scene
  std::uint64_t seed = 0;
};

/// The use of signals that were given.
using GivenSignals = std::variant<ReusedSignals, MisfitReason>;

}  // namespace shelfbeam
