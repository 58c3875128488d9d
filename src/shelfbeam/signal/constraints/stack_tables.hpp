#pragma once

#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

struct NamedTable {
  std::string name;  ///< of the scenario, unique
  std::string file;  ///< for errors
  SignalTable table;
};

/// One table whose rows are those of all scenarios, one after the other, so that a selection for it serves
/// every one of them. The columns are those of the first; the others must have the same ids, in any order,
/// with the same costs and installed units, and at the same places as far as both know places. Ids of labels
/// become "NAME:ID". A single table is returned as it is. Throws InputError that names file and id where
/// something does not agree.
/// Precondition: at least one table, none with SignalTable::apart or scenarios.
SignalTable stack_tables(std::vector<NamedTable> tables);

}  // namespace shelfbeam
