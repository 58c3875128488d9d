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

namespace shelfbeam::app {

struct BatchOptions {
  std::vector<ListedStore> stores;
  BatchFolder folder;
  std::vector<std::string> plan_options;
  std::uint64_t seed = 1;
  unsigned threads = 1;    ///< of all plans together
  unsigned jobs = 1;       ///< max number of plans at a time
  std::size_t memory = 0;  ///< of all plans together, bytes
  bool safe_csv = false;
};

/// Names of the files with the results.
inline constexpr auto database_name = "results.sqlite", table_name = "results.csv",
                      page_name = "results.html";

/// Plans the stores that have no final record with the same input, several at a time, each in a process of
/// its own, and writes their records. A plan that may have lacked memory beside others is tried again alone.
/// Calls `finished` after each record. Returns false if cancelled:
/// the plans have then saved their checkpoints. Throws OutputError if a record cannot be written.
bool run_batch(const BatchOptions& options, const std::function<void()>& finished, const RunControl& control);

/// The results of all stores, sorted by need.
std::vector<StoreResult> batch_results(const BatchOptions& options);

/// Writes database, table and page. Throws OutputError.
void write_results(const BatchOptions& options, const std::vector<StoreResult>& results);

}  // namespace shelfbeam::app
