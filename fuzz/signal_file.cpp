#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_reading.hpp"

#include "hdf5_checksums.hpp"
#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"

namespace shelfbeam::fuzz {

namespace {

void read(std::string_view bytes) {
  const std::filesystem::path path = scratch().write("signal.h5", bytes);
  try {
    read_signal_file(path);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("HDF5 library cannot read it") != std::string_view::npos) throw;
  }
  // What a child process reaches is not counted, so what it bore is read again here.
  detail::read_signal_file_here(path);
}

std::vector<std::string> seeds() {
  std::vector<std::string> files;
  SignalMatrix one = small_matrix();
  one.by_bounce.clear();
  one.flags.clear();
  for (const SignalMatrix& matrix : {small_matrix(), one}) {
    const std::filesystem::path path = scratch().path() / "seed.h5";
    write_signal_file(matrix, path);
    files.push_back(read_file(path));
  }
  for (const char* name :
       {"claims_chunk", "claims_entries", "claims_labels", "claims_text_length", "foreign", "variable_texts"})
    files.push_back(source_file(std::string("test/data/signal/") + name + ".h5"));
  return files;
}

}  // namespace

extern const Reader signal_file;
const Reader signal_file{"signal_file", read, seeds, repair_hdf5_checksums};

}  // namespace shelfbeam::fuzz
