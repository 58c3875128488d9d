#include "shelfbeam/signal/tables/formats.hpp"

#include "reader.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_sparse_text(std::string_view bytes) {
  detail::read_sparse_text(bytes, "matrix.txt");
}

std::vector<std::string> sparse_text_seeds() {
  return {"2 3 1\n2 0 0.5 2 1.5\n1 1 1\n", "1 1 0.8\n0\n",
          "3 4 1e0\n1 3 0.25\n4 0 1 1 1 2 1 3 1\n2 2 0 1 1e-3\n"};
}

}  // namespace

extern const Reader sparse_text;
const Reader sparse_text{"sparse_text", fuzz_sparse_text, sparse_text_seeds};

}  // namespace shelfbeam::fuzz
