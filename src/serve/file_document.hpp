#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "serve/http/options.hpp"

namespace shelfbeam::serve {

/// A file for a page; nothing if it is missing, is a link, or has more bytes. `is_report`: it has scripts
/// of its own.
std::optional<http::Document> document_of(const std::filesystem::path& file, bool is_report = false,
                                          std::uint64_t max_bytes = 512 << 20);

}  // namespace shelfbeam::serve
