#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam {

/// The program's version, "major.minor.patch".
std::string_view program_version();

/// 128-bit content hash (XXH3) as 32 hexadecimal digits.
std::string content_hash(std::string_view content);

/// Hash of the rest of the stream, which is read one megabyte at a time.
std::string content_hash(std::istream& content);

/// Well-mixed 64-bit hash of a text; the key of the random streams of a named object.
std::uint64_t hash64(std::string_view text);

/// The origin of a result; written to every file that contains results.
struct Provenance {
  std::string program_version;
  std::string store_hash;  ///< scene_hash of the simulated store; empty for an imported matrix
  std::uint64_t seed = 0;
  std::string estimator;  ///< e.g. "uniform mis (balance), direct exact"; empty for an imported matrix
  /// light_keys of the simulated store; nothing if unknown, as up to version 0.3.
  std::optional<std::string> light_hash = {};
  bool complete = true;  ///< the simulation was not interrupted

  bool operator==(const Provenance&) const = default;
};

}  // namespace shelfbeam
