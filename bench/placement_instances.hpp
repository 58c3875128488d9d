#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::bench {

/// Visits the matrices of these files, or by default simulated matrices of the thesis environment, each with
/// its requirements multiplied by every scale. Only one matrix is in memory at a time.
void for_instances(const std::vector<std::string>& files, const std::vector<double>& scales,
                   const std::function<void(const std::string& name, const SignalTable&)>& visit);

}  // namespace shelfbeam::bench
