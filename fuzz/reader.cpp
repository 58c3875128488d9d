#include "reader.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::fuzz {

extern const Reader catalogue, checkpoint, csv_table, device_csv, eulumdat, http_request, ies, light_operator,
    matrix, measurements, mesh, npy_table, or_library, placement_file, planogram, selection_csv, sparse_text,
    store, text_edit, websocket;

std::span<const Reader> readers() {
  static const std::array all{store,          catalogue,  planogram,    csv_table,     npy_table,
                              sparse_text,    or_library, matrix,       checkpoint,    ies,
                              eulumdat,       mesh,       device_csv,   selection_csv, measurements,
                              placement_file, websocket,  http_request, text_edit,     light_operator};
  return all;
}

const Reader* find_reader(std::string_view name) {
  const auto all = readers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Reader& r) { return r.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> foreign_texts(const std::string& text) {
  std::string old = text, wide = "\xFF\xFE";
  std::replace(old.begin(), old.end(), '\n', '\r');
  for (const char c : text) wide += {c, '\0'};
  return {"\xEF\xBB\xBF" + text, old, wide};
}

std::string source_file(std::string_view path) {
  return read_file(std::filesystem::path(SHELFBEAM_SOURCE_DIR) / path);
}

}  // namespace shelfbeam::fuzz
