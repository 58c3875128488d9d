#pragma once

#include <string>

namespace shelfbeam::fuzz {

/// Corrects the hashes of the records in a file (docs/formats/checkpoint.md).
void repair_records(std::string& bytes);

}  // namespace shelfbeam::fuzz
