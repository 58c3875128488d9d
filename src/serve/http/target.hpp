#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam::serve::http {

/// What a request asks for: "/TOKEN/NAME". The name may be empty, and may have further segments.
struct Target {
  std::string token, name;
};

/// Reads a request target and decodes its percent signs once. Nothing for what no link of ours contains:
/// another form than an absolute path ("http://...", "*"), a query, an empty segment, "." or ".." as a
/// segment, an encoded slash, and, encoded or not, a backslash, a control character, a byte beyond ASCII, or
/// a percent sign after the decoding.
std::optional<Target> parse_target(std::string_view text);

}  // namespace shelfbeam::serve::http
