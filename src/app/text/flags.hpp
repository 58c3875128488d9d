#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::app {

/// The message of an error of the library, which does not know the names of the flags.
std::string with_flag(std::string_view message, Setting setting);

}  // namespace shelfbeam::app
