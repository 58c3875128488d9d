#pragma once

#include <filesystem>

namespace shelfbeam {

/// The number of threads that can run at once, at least 1: one per core on which this process may run, and
/// not more than the processor time that its control groups (containers) may use. Results do not depend on
/// it.
unsigned core_count();

namespace detail {

/// How many cores' time the control groups allow together; infinite without a quota.
double core_quota(const std::filesystem::path& system = "/");

}  // namespace detail

}  // namespace shelfbeam
