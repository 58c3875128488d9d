#pragma once

#include <functional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/report/batch/store_result.hpp"

#include "app/batch/run_batch.hpp"

namespace shelfbeam::app {

/// Reads the stores of plans before the first plan begins: calls `read` for each, several at a time, each in
/// a process of its own. Where it throws InputError, the plan is removed, and the record of its store
/// written. Returns these results. Lack of memory and crashes are left to the plan, which has its own limits.
std::vector<StoreResult> remove_unreadable(const BatchOptions& options, std::vector<OpenPlan>& plans,
                                           const std::function<void(const ListedStore&)>& read,
                                           const RunControl& control);

}  // namespace shelfbeam::app
