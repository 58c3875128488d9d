#pragma once

#include <cstddef>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::fuzz {

/// Three labels L0, L1, L2 and four transceivers T0 to T3, the last installed.
SignalMatrix small_matrix();
SignalTable small_table();

}  // namespace shelfbeam::fuzz
