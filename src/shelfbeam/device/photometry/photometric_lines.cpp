#include "shelfbeam/device/photometry/photometric_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::size_t max_text_bytes = 64'000'000;  // measured files have a few kilobytes

// A table beyond these limits is not a measurement, and scaling it could overflow.
constexpr double min_integral = 1e-15, largest_integral = 1e15;
constexpr double largest_intensity = 1e30;  // the integral of a table is finite

}  // namespace

PhotometricLines::PhotometricLines(std::string_view text, std::string name)
    : name_(std::move(name)), characters_(text.size()) {
  if (text.size() > max_text_bytes)
    fail(0, fmt::format("has {} characters, too many for a photometric file", text.size()),
         "check that it is the right file");
  text = without_mark(text, name_);
  while (!text.empty() && (text.back() == '\x1A' || text.back() == '\0')) text.remove_suffix(1);
  while (!text.empty()) lines_.push_back(trim(take_line(text)));
}

void PhotometricLines::fail(std::size_t line, const std::string& problem,
                            const std::string& suggestion) const {
  throw InputError(line == 0 ? name_ : fmt::format("{}: line {}", name_, line), problem, suggestion);
}

std::size_t PhotometricLines::whole(double value, std::size_t low, std::size_t high,
                                    std::string_view what) const {
  if (value != std::floor(value) || value < static_cast<double>(low) || value > static_cast<double>(high))
    fail(fmt::format("{} is {}", what, value),
         fmt::format("a whole number from {} to {} is expected", low, high));
  return static_cast<std::size_t>(value);
}

std::string_view PhotometricLines::next(std::string_view what) {
  if (at_end())
    fail(lines_.size(), fmt::format("the file ends where {} is expected", what),
         "check the counts, or download the file again if it is truncated");
  return lines_[next_++];
}

std::size_t PhotometricLines::remaining_values() const {
  return static_cast<std::size_t>(
      std::count_if(lines_.begin() + static_cast<std::ptrdiff_t>(next_), lines_.end(),
                    [](std::string_view line) { return !line.empty() && line != "END"; }));
}

void PhotometricLines::expect_end(std::string_view rest) {
  while (rest.empty() || rest == "END") {
    if (at_end()) return;
    rest = next("");
  }
  fail(next_, fmt::format("the file continues after its last intensity with {}", in_quotes(rest)),
       "check its counts; a file contains one luminaire");
}

double PhotometricLines::intensity(double value, double factor) const {
  if (value < 0) fail(fmt::format("an intensity is {}", value), "it must not be negative");
  const double scaled = value * factor;
  if (!(scaled <= largest_intensity))
    fail(fmt::format("an intensity is {:.3g}", scaled),
         "check the intensities and the factors in the head of the file");
  return scaled;
}

DirectionTable PhotometricLines::checked(DirectionTable table) const {
  if (!(table.integral() >= min_integral))
    fail(0, "emits nothing: its intensities or multipliers are zero", "use a file with a profile");
  if (table.integral() > largest_integral)
    fail(0, fmt::format("has a flux of {:.3g}", table.integral()), "check its intensities and multipliers");
  return table;
}

std::optional<double> finite_number(std::string_view word) {
  const auto value = to_number(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double snapped(double angle) {
  const double exact = 90 * std::round(angle / 90);
  return std::abs(angle - exact) < 1e-3 ? exact : angle;
}

}  // namespace shelfbeam::detail
