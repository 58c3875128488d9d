#include "app/text/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/text/width.hpp"

namespace shelfbeam::app {

namespace {

/// The stages of `plan` and `verify` that simulate and search themselves.
constexpr std::array<std::string_view, 5> stages{"verifying", "proving", "refining", "curve", "sensitivity"};

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

std::string progress_line(const Progress& progress, std::size_t width) {
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
  std::string line = fitted(progress.task, width - end.size());
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

double RemainingTime::update(double fraction, double now) {
  const bool has_restarted = first_ < 0 || fraction < 0.5 * last_fraction_;
  if (fraction < 0 || has_restarted) {
    first_ = fraction;
    begun_ = now;
    end_ = -1;
  }
  const double elapsed = now - begun_, done = fraction - first_, since_last = now - last_;
  last_ = now;
  last_fraction_ = fraction;
  if (fraction >= 0 && done >= 0.01 && elapsed >= 1) {
    const double left = elapsed * (1 - fraction) / done;
    const double inertia = std::max(2.0, 0.1 * left);  // seconds
    const double weight = end_ < 0 ? 1 : 1 - std::exp(-since_last / inertia);
    end_ = end_ < 0 ? now + left : end_ + weight * (now + left - end_);
  }
  return end_ < 0 ? -1 : std::max(0.0, end_ - now);
}

Progress ProgressStages::update(std::string_view task, double fraction, std::string_view detail, double now) {
  const bool is_stage = std::find(stages.begin(), stages.end(), task) != stages.end();
  in_stage_ = in_stage_ || is_stage;
  const bool is_step = in_stage_ && !is_stage;
  if (!is_step) {
    if (task != shown_) {
      begun_ = now;
      remaining_ = {};
    }
    shown_ = task;
    detail_ = detail;
    stage_fraction_ = fraction;
  } else if (stage_fraction_ >= 0) {
    fraction = stage_fraction_;
  } else if (task != step_) {  // a stage without a share of its own shows that of its steps
    remaining_ = {};
  }
  step_ = task;
  return {shown_, fraction, now - begun_, remaining_.update(fraction, now), detail_};
}

}  // namespace shelfbeam::app
