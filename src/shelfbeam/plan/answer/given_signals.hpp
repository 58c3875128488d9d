#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The kind of difference between signals and a scene that they do not fit.
enum class Misfit : std::uint8_t {
  states,        ///< they are of a changing shop
  part,          ///< they are a part of a simulation
  incomplete,    ///< their simulation was interrupted
  paths,         ///< it allowed another number of bounces, or its strategy finds other light
  store,         ///< another store, by its hash, in a file without light_hash
  coats,         ///< an earlier version omitted the light that smooth coats of curved meshes reflect first
  light,         ///< other surfaces, materials or wavelength
  labels,        ///< labels of the scene are missing
  transceivers,  ///< transceivers of the scene are missing
};
template <>
inline constexpr auto names_of<Misfit> =
    std::to_array<Named<Misfit>>({{"states", Misfit::states},
                                  {"part", Misfit::part},
                                  {"incomplete", Misfit::incomplete},
                                  {"paths", Misfit::paths},
                                  {"store", Misfit::store},
                                  {"coats", Misfit::coats},
                                  {"light", Misfit::light},
                                  {"labels", Misfit::labels},
                                  {"transceivers", Misfit::transceivers}});

struct MisfitReason {
  struct Missing {
    std::size_t count = 0;
    std::string first;  ///< id of one of them
  };

  Misfit code = Misfit::light;
  std::optional<Missing> missing = {};  ///< labels or transceivers
};

/// Signals that another run has simulated.
struct ReusedSignals {
  std::size_t labels = 0, transceivers = 0;  ///< numbers in the file, which may have more than the scene
  std::uint64_t seed = 0;
};

/// The use of signals that were given.
using GivenSignals = std::variant<ReusedSignals, MisfitReason>;

}  // namespace shelfbeam
