#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam::serve {

/// The keys and indices of a JSON pointer (RFC 6901); nothing if it is not one.
std::optional<std::vector<std::string>> pointer_steps(std::string_view pointer);

}  // namespace shelfbeam::serve
