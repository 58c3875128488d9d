#pragma once

#include <array>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// The words for a question on the command line and in placement.json.
template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};

inline constexpr std::array model_names = {
    Named<CommunicationModel>{"cooperative", CommunicationModel::cooperative},
    Named<CommunicationModel>{"non-cooperative", CommunicationModel::non_cooperative}};

inline constexpr std::array objective_names = {
    Named<Objective>{"count", Objective::count}, Named<Objective>{"links", Objective::links},
    Named<Objective>{"effective-links", Objective::effective_links},
    Named<Objective>{"signal", Objective::signal}};

inline constexpr std::array combination_names = {
    Named<Combination>{"lexicographic", Combination::lexicographic},
    Named<Combination>{"weighted", Combination::weighted}};

inline constexpr std::array status_names = {
    Named<Status>{"optimal", Status::optimal}, Named<Status>{"feasible", Status::feasible},
    Named<Status>{"infeasible", Status::infeasible}, Named<Status>{"stopped", Status::stopped}};

inline constexpr std::array bound_proof_names = {
    Named<BoundProof>{"trivial", BoundProof::trivial}, Named<BoundProof>{"dual", BoundProof::dual},
    Named<BoundProof>{"log", BoundProof::log}, Named<BoundProof>{"search", BoundProof::search},
    Named<BoundProof>{"solver", BoundProof::solver}};

template <class Table, class Enum>
constexpr std::string_view name_of(const Table& names, Enum value) {
  for (const auto& entry : names)
    if (entry.value == value) return entry.name;
  return {};
}

}  // namespace shelfbeam
