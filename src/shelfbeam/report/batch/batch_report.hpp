#pragma once

#include <span>
#include <string>

#include "shelfbeam/report/batch/store_result.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// The number of stores, and of those that need attention, by reason; then the planned stores for which fewer
/// units, or a lower price, may be enough.
std::string batch_answer(const Words& words, std::span<const StoreResult> results);

/// The results as a table, in their order; times and memory are in the last columns. Free texts are made safe
/// for spreadsheets with `safe`.
std::string batch_csv(std::span<const StoreResult> results, bool safe);

/// A page with one table per reason for attention, with links to the reports. `results`: most urgent first.
std::string batch_html(const Words& words, std::span<const StoreResult> results);

}  // namespace shelfbeam
