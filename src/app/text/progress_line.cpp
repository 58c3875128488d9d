#include "app/text/progress_line.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/text/width.hpp"

namespace shelfbeam::app {

namespace {

constexpr std::size_t max_bar = 30, min_bar = 5, min_detail = 12;
constexpr std::string_view usual_time_left = "  59 min left";

std::string bar(double fraction, std::size_t width) {
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
  return fmt::format("[{}{}]", std::string(filled, '#'), std::string(width - filled, '.'));
}

// The first parts of a list "a, b, c" that fit; if there are none, its first letters.
std::string fitted_list(std::string_view text, std::size_t columns) {
  std::string_view parts = text;
  while (width_of(parts) > columns && parts.find(", ") != std::string_view::npos)
    parts = parts.substr(0, parts.rfind(", "));
  return fitted(width_of(parts) > columns ? text : parts, columns);
}

}  // namespace

std::string duration_text(double seconds) {
  const long exact = std::lround(std::ceil(seconds));
  if (exact <= 15) return fmt::format("{} s", exact);
  if (exact <= 55) return fmt::format("{} s", (exact + 4) / 5 * 5);
  const long minutes = std::lround(seconds / 60);
  if (minutes < 60) return fmt::format("{} min", minutes);
  const long coarse = std::lround(seconds / 300) * 5, hours = coarse / 60, rest = coarse % 60;
  return rest == 0 || hours >= 10 ? fmt::format("{} h", hours) : fmt::format("{} h {} min", hours, rest);
}

std::string progress_line(const jobs::Progress& progress, std::size_t width) {
  const bool has_share = progress.fraction >= 0;
  const double fraction = std::min(1.0, progress.fraction);
  std::string end;
  if (has_share) {
    end = fmt::format(" {:3.0f} %", std::floor(100 * fraction + 1e-9));  // 100 % only when nothing is left
    if (fraction < 1 && progress.seconds_left >= 0)
      end += fmt::format("  {} left", duration_text(progress.seconds_left));
  } else {
    end = " " + duration_text(progress.seconds);
  }
  if (end.size() >= width) end.clear();
  std::string line = fitted(to_text(progress.task), width - end.size());
  std::size_t left = width - end.size() - width_of(line);
  // The bar keeps its length when the time left appears.
  const std::size_t share_and_time = std::string_view(" 100 %").size() + usual_time_left.size();
  const std::size_t reserved = share_and_time - std::min(share_and_time, end.size());
  constexpr std::size_t around = 3;  // a blank and the brackets
  if (has_share && left >= reserved + around + min_bar) {
    const std::size_t length = std::min(max_bar, left - reserved - around);
    line += " " + bar(fraction, length);
    left -= around + length;
  }
  line += end;
  const std::size_t needed = width_of(progress.detail);
  if (needed > 0 && left >= 2 + std::min(needed, min_detail))
    line += "  " + fitted_list(progress.detail, left - 2);
  return line;
}

}  // namespace shelfbeam::app
