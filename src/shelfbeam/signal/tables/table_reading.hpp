#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/base/names.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The reading of a text that fits several.
enum class TableReading {
  automatic,  ///< the only one that fits; a text that fits several is refused
  signals,    ///< CSV without ids
  header,     ///< CSV with the ids of transceivers in its first row
  labels,     ///< CSV with the ids of labels in its first column, without a header
  ids,        ///< CSV with the ids of transceivers in its first row and of labels in its first column
  sparse,     ///< sparse text
  scp,        ///< OR-Library, row by row
  rail        ///< OR-Library, column by column
};

template <>
inline constexpr std::array<Named<TableReading>, 8> names_of<TableReading>{
    {{"auto", TableReading::automatic},
     {"signals", TableReading::signals},
     {"header", TableReading::header},
     {"labels", TableReading::labels},
     {"ids", TableReading::ids},
     {"sparse", TableReading::sparse},
     {"scp", TableReading::scp},
     {"rail", TableReading::rail}}};

struct ReadTable {
  SignalTable table;
  std::vector<Finding> warnings = {};  ///< about ids that a spreadsheet has probably changed
};

/// Like `read_signal_table`, in a given reading. Throws InputError, too, for formats that have no readings.
ReadTable read_table(const std::filesystem::path& path, TableReading reading);

}  // namespace shelfbeam
