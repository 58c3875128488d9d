#include "shelfbeam/base/format_version.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

void expect_format_version(const std::string& where, std::int64_t found, std::int64_t known) {
  if (found != known)
    throw InputError(where, fmt::format("is of format version {}, this program reads {}", found, known),
                     found > known ? "use a newer version of shelfbeam"
                                   : "use the version of shelfbeam that wrote it, or make it anew");
}

}  // namespace shelfbeam
