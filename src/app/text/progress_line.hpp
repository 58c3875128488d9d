#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "jobs/progress.hpp"

namespace shelfbeam::app {

/// One line of at most `width` columns: the task, its share and time left, or its duration if the end is
/// unknown. If the width does not suffice, the detail is shortened and then omitted, then the bar, then the
/// task is shortened.
std::string progress_line(const jobs::Progress& progress, std::size_t width);

/// "45 s", "3 min", "1 h 20 min": rounded to steps that are easy to read while they change.
std::string duration_text(double seconds);

}  // namespace shelfbeam::app
