#include "serve/file_document.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "serve/live/newest_plan.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

std::string_view media_type(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".csv")) return "text/csv; charset=utf-8";
  if (name.ends_with(".json")) return "application/json";
  if (name.ends_with(".zip")) return "application/zip";
  return "application/octet-stream";
}

}  // namespace

std::optional<http::Document> document_of(const fs::path& file, bool is_report) {
  constexpr std::uint64_t max_bytes = 512 << 20;
  if (!is_plain_file(file)) return {};
  try {
    return http::Document{std::string(media_type(file.filename().string())),
                          std::make_shared<const std::string>(read_file(file, max_bytes)), is_report};
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace shelfbeam::serve
