#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::bench {

/// The matrices of these files, or without any those of the thesis environment, simulated here; each with its
/// requirements times every scale. One is in memory at a time.
void for_instances(const std::vector<std::string>& files, const std::vector<double>& scales,
                   const std::function<void(const std::string& name, const SignalTable&)>& visit);

}  // namespace shelfbeam::bench
