#pragma once

#include <string>

#include "command.hpp"

namespace shelfbeam::manual {

/// Scripts that complete verbs, options, and values with few choices; anything else is a file.
std::string bash_completion(const Program& program);
std::string zsh_completion(const Program& program);

}  // namespace shelfbeam::manual
