#pragma once

#include <cstddef>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::app {

/// Reads a store file; the files that it names lie in its folder unless `allow_outside`. `memory`: bytes, 0
/// for most of what the machine has.
Store load_store(const std::filesystem::path& path, bool allow_outside = false, std::size_t memory = 0);

/// What placements are asked about, before there is any signal: labels and candidates of a scene.
SignalTable table_without_signals(const Scene& scene);

/// --allow-outside.
void add_store_options(CLI::App& verb, bool& allow_outside);

}  // namespace shelfbeam::app
