#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace shelfbeam::app {

/// Standard input, of at most `limit` bytes. Throws InputError with `remedy`.
std::string standard_input(std::size_t limit, const std::string& remedy);

/// Writes to standard output at once. Returns whether the reader is still there.
bool write_at_once(std::string_view bytes);

}  // namespace shelfbeam::app
