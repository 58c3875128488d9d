#include "app/options/values.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::app {

namespace {

std::optional<double> finite_number(std::string_view text) {
  const std::optional<double> value = to_number(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// The number of percent, with the rounding of its decimal fraction: "99.9" is 0.999.
std::optional<double> from_percent(std::string_view text) {
  if (const auto value = finite_number(fmt::format("{}e-2", text))) return value;
  const auto value = finite_number(text);
  return value ? std::optional(*value / 100) : std::nullopt;
}

bool accepts(const Shares& shares, double share) {
  return share <= shares.most && (shares.includes_least ? share >= shares.least : share > shares.least);
}

bool is_ambiguous(const Shares& shares, double bare) {
  return bare > 1 && !std::isfinite(shares.most);
}

// "a share from 0 to 1", "a share above 0, at most 1", "a share above 0"
std::string kind_of(const Shares& shares) {
  if (!std::isfinite(shares.most)) return fmt::format("a share above {}", shares.least);
  return shares.includes_least ? fmt::format("a share from {} to {}", shares.least, shares.most)
                               : fmt::format("a share above {}, at most {}", shares.least, shares.most);
}

}  // namespace

CLI::Validator positive_number(const std::string& name) {
  const auto check = [](const std::string& text) {
    const auto value = finite_number(text);
    if (!value || !(*value > 0)) return fmt::format("'{}' is not a finite number above 0", text);
    return *value > max_amount ? fmt::format("'{}' is greater than 1e18", text) : std::string();
  };
  return {check, name};
}

CLI::Validator number_from_zero(const std::string& name) {
  const auto check = [](const std::string& text) {
    const auto value = finite_number(text);
    return value && *value >= 0 ? std::string() : fmt::format("'{}' is not a number of at least 0", text);
  };
  return {check, name};
}

std::optional<Share> share_of(std::string_view text) {
  constexpr std::uint32_t max_parts = 10'000;
  Share part;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, part.number);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(number.ptr + 1, end, part.count);
  if (count.ec != std::errc() || count.ptr != end) return std::nullopt;
  if (part.number < 1 || part.number > part.count || part.count > max_parts) return std::nullopt;
  return part;
}

CLI::Validator a_part() {
  const auto check = [](const std::string& text) {
    return share_of(text) ? std::string() : fmt::format("'{}' is not a part such as 2/4", text);
  };
  return {check, "K/N"};
}

// CLI11 clamps numbers that are too large to the largest number of the type.
CLI::Validator whole_number(const std::string& name, std::uint64_t least, std::uint64_t most) {
  const auto check = [least, most](const std::string& text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && stop == end && value >= least && value <= most) return std::string();
    return most == std::numeric_limits<std::uint64_t>::max()
               ? fmt::format("'{}' is not a whole number of at least {}, or is too large", text, least)
               : fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
  };
  return {check, name};
}

CLI::Validator a_path(const std::string& name) {
  const auto check = [](const std::string& text) {
    if (text.empty()) return std::string("the name is empty");
    return text.starts_with("--")
               ? fmt::format("'{0}' is an option, not a path; for a file of this name, give ./{0}", text)
               : std::string();
  };
  return {check, name};
}

CLI::Validator an_id() {
  const auto check = [](const std::string& text) {
    return text.empty() ? std::string("the id is empty") : std::string();
  };
  return {check, "ID"};
}

std::string choices(const std::vector<std::string>& names) {
  return fmt::format("{{{}}}", fmt::join(names, ","));
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto check = [names](const std::string& text) {
    for (const std::string& name : names)
      if (name == text) return std::string();
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fmt::format("unknown value '{}'; {}", text, suggest(text, known));
  };
  return {check, choices(names)};
}

CLI::Validator size_in_bytes() {
  const auto read = [](std::string& text) {
    std::string problem = fmt::format("'{}' is not a size such as 4G or 500M", text);
    // CLI11 reads "-1" as the largest number, and "G" as 1G.
    if (text.find_first_of("0123456789") != 0) return problem;
    try {
      const std::string error = CLI::AsSizeValue(true)(text);
      return error.empty() && positive_number("")(text).empty() ? std::string() : problem;
    } catch (const CLI::ValidationError&) {
      return problem;
    }
  };
  return {read, "SIZE"};
}

CLI::Validator a_share(const std::string& name, const Shares& shares) {
  const auto read = [shares](std::string& text) {
    std::string_view number = trim(text);
    const bool is_percent = number.ends_with('%');
    if (is_percent) number = trim(number.substr(0, number.size() - 1));
    const std::optional<double> bare = finite_number(number), hundredth = from_percent(number);
    if (!bare) return fmt::format("'{}' is not a share such as 0.05 or 5%", text);
    const bool reads_percent = is_percent || (shares.reads_percent && *bare >= 2 && *bare <= 100);
    if (!reads_percent && is_ambiguous(shares, *bare))
      return fmt::format("'{}' can mean {} or {:g} percent; give {}% or {:g}%", text, number, 100 * *bare,
                         number, 100 * *bare);
    const double value = reads_percent ? *hundredth : *bare;
    if (!accepts(shares, value)) {
      std::string problem = fmt::format("'{}' is not {}", text, kind_of(shares));
      if (shares.reads_percent)
        problem += ", such as 0.99 or 99%";
      else if (!reads_percent && *bare > 0 && accepts(shares, *hundredth))
        problem += fmt::format("; for {} percent, give {} or {}%", number, *hundredth, number);
      return problem;
    }
    text = fmt::format("{}", value);
    return std::string();
  };
  return {read, name};
}

}  // namespace shelfbeam::app
