#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace shelfbeam::detail {

/// The description of the data of an NPY file.
struct NpyHeader {
  bool is_double = false;      ///< 64-bit instead of 32-bit floats
  bool columns_first = false;  ///< Fortran order
  std::size_t rows = 0, columns = 0;
};

/// Reads the Python dictionary with the keys 'descr', 'fortran_order' and 'shape', in any order and notation.
/// Throws InputError for any other text and for data that are not a matrix of little-endian floats. Errors
/// name the file as `name`.
NpyHeader parse_npy_header(std::string_view text, const std::string& name);

}  // namespace shelfbeam::detail
