#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "shelfbeam/signal/tables/table_reading.hpp"

// One reader per matrix format (docs/formats/matrices.md). Errors name the file as `name`.

namespace shelfbeam::detail {

/// All formats except the signal file, for messages.
inline constexpr auto matrix_formats = "CSV, NPY, sparse text, or OR-Library scp or rail file";

ReadTable read_csv_table(std::string_view text, const std::string& name,
                         TableReading reading = TableReading::automatic);
SignalTable read_sparse_text(std::string_view text, const std::string& name);
SignalTable read_or_library(std::string_view text, const std::string& name,
                            TableReading reading = TableReading::automatic);
SignalTable read_npy_table(const std::filesystem::path& path);

/// Name the rows L1, L2, ... and the columns T1, T2, ... of a file without ids.
void number_labels(SignalTable& table, std::size_t count);
void number_transceivers(SignalTable& table, std::size_t count);

/// Throws InputError when two labels or two transceivers have the same id.
void check_unique_ids(const SignalTable& table, const std::string& name);

}  // namespace shelfbeam::detail
