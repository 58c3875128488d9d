#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

namespace shelfbeam {

/// The program's version, "major.minor.patch".
std::string_view program_version();

/// 128-bit content hash (XXH3) as 32 hexadecimal digits.
std::string content_hash(std::string_view content);

/// Hash of the rest of the stream, read one megabyte at a time.
std::string content_hash(std::istream& content);

/// Well-mixed 64-bit hash of a text: the key of random streams that belong to a named thing.
std::uint64_t hash64(std::string_view text);

/// Where a result comes from; written into every file that carries results.
struct Provenance {
  std::string program_version;
  std::string store_hash;  ///< scene_hash of what was simulated; empty for a matrix from elsewhere
  std::uint64_t seed = 0;
  std::string estimator;  ///< e.g. "uniform mis (balance), direct exact"; empty for a matrix from elsewhere

  bool operator==(const Provenance&) const = default;
};

}  // namespace shelfbeam
