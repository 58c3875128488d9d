#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shelfbeam {

/// The properties that a run must share with a file to resume from it: names and values, in a fixed order,
/// without line breaks.
using CheckpointIdentity = std::vector<std::pair<std::string, std::string>>;

namespace detail {

/// A line per property.
std::string to_text(const CheckpointIdentity& identity);

/// Throws InputError if the file at `path`, which contains the text `found`, belongs to another run; the
/// error names the first property that differs.
void expect_identity(const CheckpointIdentity& identity, std::string_view found,
                     const std::filesystem::path& path);

/// Throws InputError if something else than a regular file that begins with `line` is at `path`.
void expect_checkpoint(const std::filesystem::path& path, std::string_view line);

}  // namespace detail
}  // namespace shelfbeam
