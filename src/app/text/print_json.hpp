#pragma once

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shelfbeam::app {

/// The summary that `--json` asks for. Paths need not be UTF-8; JSON must.
inline void print_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace shelfbeam::app
