#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam::app {

/// Reads a store file and the files that it names; these must be in its folder unless `allow_outside`.
/// `memory`: limit in bytes, 0 for memory_limit(). `output`: a file that the run will write. `cancel` ends
/// the reading and all work on the store. With `problems`, collects all of them instead of throwing the
/// first.
Store load_store(const std::filesystem::path& path, bool allow_outside = false, std::size_t memory = 0,
                 const std::filesystem::path& output = {}, const CancelToken* cancel = nullptr,
                 Problems* problems = nullptr);

/// Throws InputError if `folder` is that of the store file, unless `plan` wrote the file: its text is
/// `resolved`. Protects the lists in its folder, too.
void protect_store(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const std::string& resolved);

/// Throws InputError if the scene has warnings and `strict` is set.
void expect_no_warnings(const Scene& scene, bool strict);

/// --allow-outside.
void add_store_options(CLI::App& verb, bool& allow_outside);
/// --strict.
void add_strict_option(CLI::App& verb, bool& strict);

/// --safe-csv.
CLI::Option* add_safe_csv(CLI::App& verb, bool& safe_csv);

/// Throws OutputError if the disk has no room for the signal file and the checkpoint of a simulation, and for
/// `others` bytes.
void expect_room_for_matrix(const std::filesystem::path& folder, const Scene& scene,
                            const SimulationOptions& options, std::size_t others = 0);

/// Adds labels.csv, placement.csv and report.html.
void write_report(AtomicFolder& files, const ReportInput& input);

}  // namespace shelfbeam::app
