#pragma once

#include <filesystem>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam::jobs {

// Plans that an earlier run wrote to a folder.

struct StoredPlan {
  Store store;
  Scene scene;
  SignalMatrix matrix;
  CertifiedPlan plan;
};

/// The plan in a folder, of any version. Throws InputError that names the missing or wrong file, also if the
/// signals are those of another store.
StoredPlan read_stored_plan(const std::filesystem::path& folder);

/// The signals of a file, or of a plan in a folder. Those of a plan of version 0.3 or earlier get their
/// light_hash from the store file of the plan, and count as incomplete if the plan was interrupted. Throws
/// InputError.
StoredSignals read_given_signals(const std::filesystem::path& signals);

/// Whether the folder contains a plan whose signals fit (fitting_signals).
bool has_fitting_signals(const std::filesystem::path& folder, const Scene& scene, const PathRules& wanted);

}  // namespace shelfbeam::jobs
