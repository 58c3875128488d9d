#pragma once

#include <array>
#include <cstddef>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

// Names of problem and result values on the command line and in placement.json.

template <>
inline constexpr auto names_of<CommunicationModel> =
    std::to_array<Named<CommunicationModel>>({{"cooperative", CommunicationModel::cooperative},
                                              {"non-cooperative", CommunicationModel::non_cooperative}});

template <>
inline constexpr auto names_of<Objective> = [] {
  std::array<Named<Objective>, objective_words.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k)
    names[k] = {objective_words[k].name, objective_words[k].value};
  return names;
}();

template <>
inline constexpr auto names_of<Combination> =
    std::to_array<Named<Combination>>({{"lexicographic", Combination::lexicographic},
                                       {"weighted", Combination::weighted},
                                       {"spend", Combination::spend}});

template <>
inline constexpr auto names_of<Status> = std::to_array<Named<Status>>({{"optimal", Status::optimal},
                                                                       {"feasible", Status::feasible},
                                                                       {"infeasible", Status::infeasible},
                                                                       {"stopped", Status::stopped}});

template <>
inline constexpr auto names_of<BoundProof> =
    std::to_array<Named<BoundProof>>({{"trivial", BoundProof::trivial},
                                      {"dual", BoundProof::dual},
                                      {"log", BoundProof::log},
                                      {"branches", BoundProof::branches},
                                      {"search", BoundProof::search},
                                      {"solver", BoundProof::solver}});

template <>
inline constexpr auto names_of<SolverChoice> =
    std::to_array<Named<SolverChoice>>({{"auto", SolverChoice::automatic},
                                        {"search", SolverChoice::search},
                                        {"mip", SolverChoice::mip},
                                        {"greedy", SolverChoice::greedy}});

}  // namespace shelfbeam
