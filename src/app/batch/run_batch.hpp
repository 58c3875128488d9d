#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/report/batch/store_result.hpp"

#include "app/batch/record.hpp"
#include "app/batch/store_list.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::app {

struct BatchOptions {
  std::vector<ListedStore> stores;
  BatchFolder folder;
  jobs::PlanJob plan;                     ///< of every store, without its paths
  std::vector<std::string> plan_options;  ///< by which an earlier run is recognised
  std::uint64_t seed = 1;
  unsigned threads = 1;    ///< of all plans together
  unsigned jobs = 1;       ///< max number of plans at a time
  std::size_t memory = 0;  ///< of all plans together, bytes
  bool safe_csv = false;
  bool keeps_answers = false;  ///< also those of other inputs, such as of other options
};

/// A plan that a batch has to make.
struct OpenPlan {
  const ListedStore* store;
  std::string input;       ///< of its record
  PlanEffort effort;       ///< of earlier runs
  bool continues = false;  ///< whether its checkpoints are of the same input
};

/// The stores without a final record of the same input, or with `keeps_answers` without any final record.
/// Throws InputError for records of a later version.
std::vector<OpenPlan> open_plans(const BatchOptions& options);

struct BatchEnd {
  bool is_complete = true;              ///< false if cancelled; the plans have then saved their checkpoints
  std::vector<StoreResult> unrecorded;  ///< plans that could not begin, or whose record could not be written
};

/// Makes the plans, several at a time, each in a process of its own, and writes their records. A plan that
/// may have lacked memory beside others is tried again alone. Calls `finished` after each record. An error of
/// one store stops no other.
BatchEnd run_batch(const BatchOptions& options, const std::vector<OpenPlan>& plans,
                   const std::function<void()>& finished, const RunControl& control);

/// The results of all stores, most urgent first. Those in `others` replace those of the records.
std::vector<StoreResult> batch_results(const BatchOptions& options,
                                       const std::vector<StoreResult>& others = {});

/// Writes database, table and page. Throws OutputError.
void write_results(const BatchOptions& options, const std::vector<StoreResult>& results);

}  // namespace shelfbeam::app
