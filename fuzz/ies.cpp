#include "shelfbeam/device/photometry/photometry.hpp"

#include "reader.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_ies(std::string_view bytes) {
  parse_ies(bytes, "profile.ies").with_integral(1);
}

std::vector<std::string> ies_seeds() {
  std::vector<std::string> files;
  for (const char* name : {"1986_axial", "1991_quadrant_tilt", "1995_bilateral_negative_sizes",
                           "2002_90_to_270_absolute", "2019_full_sphere", "b_full", "b_half", "b_quadrant",
                           "commas_and_wrapped_lines", "open_circle", "upwards"})
    files.push_back(source_file(std::string("test/data/photometry/") + name + ".ies"));
  files.push_back(source_file("data/photometry/wide-ceiling.ies"));
  for (const char* name : {"planes_flow", "one_line"})
    files.push_back(source_file(std::string("test/data/field/") + name + ".ies"));
  return files;
}

}  // namespace

extern const Reader ies;
const Reader ies{"ies", fuzz_ies, ies_seeds};

}  // namespace shelfbeam::fuzz
