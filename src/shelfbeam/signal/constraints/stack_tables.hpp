#pragma once

#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

struct NamedTable {
  std::string name;  ///< unique name of the scenario
  std::string file;  ///< for errors
  SignalTable table;
};

/// Stacks the rows of all scenarios in one table, so that a selection feasible for it is feasible for every
/// scenario. The columns are those of the first table. The other tables must have the same ids, in any order,
/// with equal costs, installed units and, if both tables have positions, positions. Label ids become
/// "NAME:ID". A single table is returned unchanged. Throws InputError with file and id for tables that do not
/// agree. Precondition: at least one table, none with SignalTable::conflicts or scenarios.
SignalTable stack_tables(std::vector<NamedTable> tables);

}  // namespace shelfbeam
