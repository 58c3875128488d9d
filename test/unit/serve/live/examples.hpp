#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"

#include "serve/text/json_value.hpp"

namespace shelfbeam::test {

/// The store file of an example.
inline std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(SHELFBEAM_SOURCE_DIR "/examples") / name / "store.json";
}

inline serve::Json example_json(const std::string& name) {
  return parse_json(read_file(example(name)), name);
}

}  // namespace shelfbeam::test
