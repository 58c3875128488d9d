#pragma once

#include <string>
#include <vector>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::test {

/// The fenced blocks of one kind in a page of docs/formats, in their order.
inline std::vector<std::string> fenced_blocks(const std::string& page, const std::string& kind) {
  const std::string text = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/" + page);
  const std::string open = "```" + kind + "\n";
  std::vector<std::string> found;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    found.push_back(text.substr(at, text.find("```", at) - at));
  }
  return found;
}

}  // namespace shelfbeam::test
