#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// Upper limit of version numbers in files; no real version reaches it.
inline constexpr std::int64_t max_versions = 1'000'000;

/// Checks the version of a file format. Versions count from 1 and change whenever older programs would
/// misread the file. Throws InputError at `where` unless `found` is the version that this program reads; the
/// message states whether a newer or an older program is required. Call it before reading the rest of the
/// file, because other versions may have other contents.
inline void expect_format_version(const std::string& where, std::int64_t found, std::int64_t known) {
  if (found != known)
    throw InputError(where, fmt::format("has format version {}, but this program reads {}", found, known),
                     found > known ? "use a newer version of shelfbeam"
                                   : "use the version of shelfbeam that wrote it, or create it again");
}

}  // namespace shelfbeam
