#pragma once

#include <cstddef>
#include <string_view>

namespace shelfbeam::serve {

/// The position behind the text in quotes that begins at `at`. Here and below, `text` is JSON.
std::size_t quoted_end(std::string_view text, std::size_t at);

/// The position behind the value that begins at `at`.
std::size_t value_end(std::string_view text, std::size_t at);

}  // namespace shelfbeam::serve
