#include "shelfbeam/device/photometry/photometry.hpp"

#include "reader.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_eulumdat(std::string_view bytes) {
  parse_eulumdat(bytes, "profile.ldt").with_integral(1);
}

std::vector<std::string> eulumdat_seeds() {
  std::vector<std::string> files;
  for (const char* name : {"comma_decimals", "no_lamps_single_plane", "symmetry_0", "symmetry_1",
                           "symmetry_2_24_planes", "symmetry_3", "symmetry_4_24_planes", "uneven_planes"})
    files.push_back(source_file(std::string("test/data/photometry/") + name + ".ldt"));
  files.push_back(source_file("data/photometry/wide-ceiling.ldt"));
  for (const char* name : {"uplight", "all_planes"})
    files.push_back(source_file(std::string("test/data/field/") + name + ".ldt"));
  return files;
}

}  // namespace

extern const Reader eulumdat;
const Reader eulumdat{"eulumdat", fuzz_eulumdat, eulumdat_seeds};

}  // namespace shelfbeam::fuzz
