#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/table_reading.hpp"

namespace shelfbeam::jobs {

/// The matrices in files, each a scenario of one placement with the shortest name that distinguishes it.
/// Throws InputError as read_table and stack_tables.
ReadTable read_scenarios(const std::vector<std::filesystem::path>& files, TableReading reading);

/// The files in an error.
std::string names_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace shelfbeam::jobs
