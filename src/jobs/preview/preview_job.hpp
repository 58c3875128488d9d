#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/preview/what_if.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"

namespace shelfbeam::jobs {

/// Units to preview in a store. Those of the plan stay, or without one those that the store chooses
/// (Transceiver::is_chosen), which are previewed, too.
struct PreviewJob {
  std::filesystem::path store;
  std::filesystem::path plan;        ///< folder of a plan; empty: none
  std::vector<std::string> added;    ///< given_unit
  std::vector<std::string> moved;    ///< moved_unit
  std::vector<std::string> removed;  ///< ids
  std::optional<double> refine_s;    ///< time for unbiased signals of all added units; none: previews
  std::uint64_t seed = 1;
  bool coarse = false;  ///< unless an operator is kept: one of little effort, which is not kept
  bool allow_outside = false;
};

/// Name of the light operator in the folder of a plan (docs/formats/preview.md).
inline constexpr auto operator_name = "light.operator";

struct PreviewResult {
  Scene scene;
  WhatIf what_if;
  bool is_stopped = false;  ///< by the user, before the refinement was complete
  std::string not_kept;     ///< why the light operator could not be kept; empty: it is, or need not be
};

/// Throws MemoryError, with the name of the store and a remedy, if the light operator of a scene does not fit
/// into the memory.
void expect_to_fit(const OperatorEffort& effort, const Scene& scene, const std::string& store,
                   const std::string& remedy);

/// Reads or computes the light operator of the store, keeps it in the folder of the plan, and previews the
/// units. Throws InputError, or Interrupted when cancelled before all previews; when refinement is cancelled,
/// its signals so far count.
PreviewResult run_preview(const PreviewJob& job, const RunControl& control);

/// The same for the scene of a store that need not be a file. `job.store` names it in errors.
PreviewResult run_preview(const PreviewJob& job, Scene shop, const RunControl& control);

}  // namespace shelfbeam::jobs
