#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam::app {

// Kinds of values of options, for CLI::Option::transform. The help shows `name` as the value, e.g. SECONDS.
// Their messages follow the name of the option.

/// A finite number above 0.
CLI::Validator positive_number(const std::string& name);
/// A finite number of at least 0.
CLI::Validator number_from_zero(const std::string& name);
/// A whole number that fits its type.
CLI::Validator whole_number(const std::string& name, std::uint64_t least,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// A path that is not empty.
CLI::Validator a_path(const std::string& name = "PATH");
/// An id, or a pattern of ids.
CLI::Validator an_id();
/// "{a,b}"
std::string choices(const std::vector<std::string>& names);
/// One of the names, shown as "{a,b}".
CLI::Validator one_of(const std::vector<std::string>& names);

/// Reads "2/4", part 2 of 4.
std::optional<Share> share_of(std::string_view text);
/// A text that `share_of` reads.
CLI::Validator a_part();

/// Reads "4G" or "500MiB" as a number of bytes.
CLI::Validator size_in_bytes();

/// The shares that an option accepts.
struct Shares {
  double least, most;
  bool includes_least = true;
  /// Whether a bare number from 2 to 100 is in percent.
  bool reads_percent = false;
};

/// Any share above 0. Shares above 1 must be in percent: nearly always, a bare 5 is meant as 5 percent.
inline constexpr Shares any_share{0, std::numeric_limits<double>::infinity(), false};

/// Reads a share, "0.05", "5%" or "5 %", as a number.
CLI::Validator a_share(const std::string& name, const Shares& shares);

}  // namespace shelfbeam::app
