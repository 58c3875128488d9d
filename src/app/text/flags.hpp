#pragma once

#include <exception>
#include <span>
#include <string>
#include <string_view>

#include "shelfbeam/base/error.hpp"

#include "jobs/event.hpp"

namespace shelfbeam::app {

/// The message of an error of the library, which does not know the names of the flags.
std::string with_flag(std::string_view message, Setting setting);

/// The same for a message about several settings.
std::string with_flags(std::string_view message, std::span<const Setting> settings);

/// The end of a job with an error of the library, as one line with the flag.
jobs::JobError job_error(const std::exception& error, Setting setting);

}  // namespace shelfbeam::app
