#include <zlib.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

// The reader detects the file type and decompresses. HDF5 files are excluded, because the HDF5 library is not
// safe against malformed files.
void fuzz_matrix(std::string_view bytes) {
  const std::filesystem::path file = scratch().write("matrix", bytes);
  if (!is_hdf5(file)) read_signal_table(file);
}

std::string gzip(const std::string& text) {
  const std::filesystem::path path = scratch().path() / "seed.gz";
  const gzFile file = gzopen(path.c_str(), "wb9");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return read_file(path);
}

std::vector<std::string> matrix_seeds() {
  std::vector<std::string> files;
  for (const std::string_view name : {"csv_table", "sparse_text", "or_library", "npy_table"}) {
    const auto theirs = find_reader(name)->seeds();
    files.insert(files.end(), theirs.begin(), theirs.end());
    if (name != "npy_table") files.push_back(gzip(theirs.front()));
  }
  return files;
}

}  // namespace

extern const Reader matrix;
const Reader matrix{"matrix", fuzz_matrix, matrix_seeds};

}  // namespace shelfbeam::fuzz
