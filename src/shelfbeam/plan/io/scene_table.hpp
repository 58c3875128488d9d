#pragma once

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The labels and transceivers of a scene as a table without signals, for files of placements.
SignalTable table_without_signals(const Scene& scene);

}  // namespace shelfbeam
