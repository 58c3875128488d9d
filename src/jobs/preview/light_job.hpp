#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"

namespace shelfbeam::jobs {

/// The light of a shop that is being drawn, and of the units on its plan.
struct LightJob {
  std::uint64_t generation = 0;
  std::string name = "store.json", text = {};  ///< of the store file
  std::filesystem::path folder = {};           ///< of the files that the store names
  std::filesystem::path keep = {};             ///< folder of the light operators
  std::vector<std::string> known = {};  ///< messages `column` of this generation, which need not be made
};

/// Names of light operators in the folder of a LightJob.
inline constexpr auto coarse_operator_name = "coarse.operator";

/// A job as the standard input of a process, and back. Throws std::exception for other bytes.
std::string input_of(const LightJob& job);
LightJob light_job_of(std::string_view input);

/// The seed of the operators that a LightJob keeps.
inline constexpr std::uint64_t light_seed = 1;

/// The operator of a LightJob with this effort: from a file, or made and kept there. `store`: its name in
/// errors. Throws as expect_to_fit, OutputError, and Interrupted.
LightOperator kept_or_made(const World& world, const std::filesystem::path& file,
                           const OperatorEffort& effort, const std::string& store, const RunControl& control);

using SendFrame = std::function<void(std::string_view)>;

/// Computes the light, from the fastest to the best: columns without reflections, a coarse operator, the
/// usual one, and unbiased columns, until no label near its requirement is undecided. Sends messages of the
/// planner's protocol (docs/formats/planner.md#light): `column`, and `state` with `phase`, `operator`,
/// `undecided` and `progress`. Operators are kept in the folder before `state` names them. Throws InputError,
/// MemoryError, OutputError, and Interrupted.
void run_light(const LightJob& job, const SendFrame& send, const RunControl& control);

}  // namespace shelfbeam::jobs
