#include "shelfbeam/signal/tables/formats.hpp"

#include "reader.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_or_library(std::string_view bytes) {
  detail::read_or_library(bytes, "scp.txt");
}

std::vector<std::string> or_library_seeds() {
  return {"2 3\n1 2 1\n2\n1 3\n1\n2\n", "3 2\n1 2 1 3\n2 1 2\n", "2 3\n5 1 1\n2 1 2\n2 1 2\n",
          " 3 4 \n 1 1 1\n 1 2\n 2 3 1 4 \n1 2\n 2 1 4\n"};
}

}  // namespace

extern const Reader or_library;
const Reader or_library{"or_library", fuzz_or_library, or_library_seeds};

}  // namespace shelfbeam::fuzz
