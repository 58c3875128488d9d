#pragma once

#include <string>

#include "command.hpp"

namespace shelfbeam::manual {

/// The manual page of section 1, as roff: of the program, which names its verbs, and of one verb.
std::string man_page(const Program& program);
std::string man_page(const Program& program, const Command& verb);

}  // namespace shelfbeam::manual
