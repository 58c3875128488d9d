#pragma once

#include <string>

namespace shelfbeam::fuzz {

/// Writes the checksums of an HDF5 file's superblock (version 2 or 3), object headers (version 2) and their
/// continuations anew, so that a changed file is read further than to its first checksum. What is too damaged
/// to tell its length stays as it is.
void repair_hdf5_checksums(std::string& bytes);

}  // namespace shelfbeam::fuzz
