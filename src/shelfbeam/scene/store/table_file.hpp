#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/encoding.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/finding/finding.hpp"

namespace shelfbeam {

/// A CSV file that a store names.
struct TableFile {
  InputFile file;
  std::optional<Encoding> encoding = {};  ///< if the file does not show its own; nothing: guessed

  /// Its text in UTF-8, with a warning if the encoding is guessed. Throws InputError if it has other bytes.
  std::string read(std::vector<Finding>& warnings) const;
};

}  // namespace shelfbeam
