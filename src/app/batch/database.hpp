#pragma once

#include <span>
#include <string>

#include "shelfbeam/report/batch/store_result.hpp"

namespace shelfbeam::app {

/// The bytes of an SQLite database with the results (docs/formats/batch.md), in their order. They depend only
/// on the results and the version of SQLite.
std::string database_of(std::span<const StoreResult> results);

}  // namespace shelfbeam::app
