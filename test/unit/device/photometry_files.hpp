#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::test {

inline const std::filesystem::path corpus_folder = SHELFBEAM_SOURCE_DIR "/test/data/photometry";
inline const std::filesystem::path data_folder = SHELFBEAM_SOURCE_DIR "/data/photometry";

inline bool is_ies(const std::filesystem::path& file) {
  return file.extension() == ".ies";
}

inline DirectionTable parse_photometry(bool ies, std::string_view text, const std::string& name) {
  return ies ? parse_ies(text, name) : parse_eulumdat(text, name);
}

inline DirectionTable read_photometry(const std::filesystem::path& file) {
  return is_ies(file) ? read_ies(file) : read_eulumdat(file);
}

/// All files of the corpus, in the order of their names.
inline std::vector<std::filesystem::path> corpus() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(corpus_folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The value at angles in degrees.
inline double value_at(const DirectionTable& table, double theta_deg, double phi_deg) {
  return table.value(radians(theta_deg), radians(phi_deg));
}

}  // namespace shelfbeam::test
