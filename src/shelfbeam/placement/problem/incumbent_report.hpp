#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::detail {

inline std::vector<std::string> ids_of(const SignalTable& table, std::span<const ColumnId> selected) {
  std::vector<std::string> ids;
  ids.reserve(selected.size());
  for (const ColumnId j : selected) ids.push_back(table.transceivers[j].id);
  return ids;
}

/// Reports the incumbent of a task and the bound on its value; to be followed by a report of the task.
inline void report_incumbent(const RunControl& control, const SignalTable& table,
                             std::span<const ColumnId> selected, double value, double bound) {
  if (control.progress == nullptr) return;
  control.progress->bounds(value, bound);
  control.progress->selection(ids_of(table, selected));
}

}  // namespace shelfbeam::detail
