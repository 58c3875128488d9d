#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The end of the plan of one store, most urgent first.
enum class StoreStatus {
  failed,      ///< the store cannot be read, or its plan ended with an error
  unfinished,  ///< there is no result yet
  infeasible,  ///< no placement reaches all labels
  undecided,   ///< a limit ended the plan
  planned
};
template <>
inline constexpr auto names_of<StoreStatus> =
    std::to_array<Named<StoreStatus>>({{"failed", StoreStatus::failed},
                                       {"unfinished", StoreStatus::unfinished},
                                       {"infeasible", StoreStatus::infeasible},
                                       {"undecided", StoreStatus::undecided},
                                       {"planned", StoreStatus::planned}});

/// The cost of a plan, over all runs that it took.
struct PlanEffort {
  double cpu_s = 0, wall_s = 0;
  std::uint64_t peak_memory = 0;  ///< bytes
  std::uint32_t runs = 0;         ///< more than one after interruptions

  bool operator==(const PlanEffort&) const = default;
};

/// A plan in a few values.
struct PlanNumbers {
  std::string answer = {};  ///< one sentence, without the scope of its confidence; or the error
  std::string basis = {};   ///< how well the values are known on which it rests; may be empty
  std::uint64_t labels = 0;
  std::optional<std::uint64_t> units = {}, lower_bound = {};  ///< of a placement
  std::optional<double> price = {};                           ///< of the new units
  std::optional<double> price_lower_bound = {};               ///< of a placement that minimises the price
  std::string currency = {};                                  ///< empty: not given
  std::vector<Finding> warnings = {};

  /// The bound leaves open whether fewer units, or a lower price, are enough.
  bool has_gap() const {
    return (units && lower_bound && *lower_bound < *units) ||
           (price && price_lower_bound && *price_lower_bound < *price);
  }
  bool operator==(const PlanNumbers&) const = default;
};

/// The object with these values; absent ones are null.
nlohmann::ordered_json to_json(const PlanNumbers& numbers);
/// The values of an object, which may have others. Throws nlohmann::json::exception.
PlanNumbers read_numbers(const nlohmann::ordered_json& json);

/// The result of one store of a batch.
struct StoreResult : PlanNumbers {
  std::string name;   ///< unique in the batch
  std::string store;  ///< path of the store file
  StoreStatus status = StoreStatus::unfinished;
  std::string report;  ///< path of the report from the folder of the results; empty without one
  PlanEffort effort;

  /// The plan can be used, but fewer units, or a lower price, may be enough.
  bool is_open() const { return status == StoreStatus::planned && has_gap(); }
  bool operator==(const StoreResult&) const = default;
};

/// Sorts the most urgent first: by status, plans with warnings before those without, then by falling price,
/// then by name.
void sort_by_need(std::vector<StoreResult>& results);

}  // namespace shelfbeam
