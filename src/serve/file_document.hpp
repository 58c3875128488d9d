#pragma once

#include <filesystem>
#include <optional>

#include "serve/http/options.hpp"

namespace shelfbeam::serve {

/// A file for a page; nothing if it is missing, is a link, or has more than 512 MiB. `is_report`: it has
/// scripts of its own.
std::optional<http::Document> document_of(const std::filesystem::path& file, bool is_report = false);

}  // namespace shelfbeam::serve
