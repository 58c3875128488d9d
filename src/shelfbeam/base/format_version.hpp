#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// Beyond any version: numbers in files are at most this.
inline constexpr std::int64_t most_versions = 1'000'000;

/// Every format of files has a version, counted from 1, that changes where older programs would misread the
/// file. Throws InputError at `where` unless `found` is the version that this program reads; it says whether
/// a newer or an older program is needed. To be asked before the rest of a file: other versions may have
/// other contents.
inline void expect_format_version(const std::string& where, std::int64_t found, std::int64_t known) {
  if (found != known)
    throw InputError(where, fmt::format("is of format version {}, this program reads {}", found, known),
                     found > known ? "use a newer version of shelfbeam"
                                   : "use the version of shelfbeam that wrote it, or make it anew");
}

}  // namespace shelfbeam
