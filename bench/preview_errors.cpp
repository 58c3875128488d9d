#include "preview_errors.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>

namespace shelfbeam::bench {

namespace {

using Sums = PreviewErrors::Sums;

constexpr double within = 1.96;

double inside_share(const std::vector<const PreviewErrors::OfUnit*>& units) {
  double inside = 0, labels = 0;
  for (const auto* unit : units) {
    inside += unit->inside;
    labels += unit->labels;
  }
  return inside / labels;
}

// The 2.5 and 97.5 % quantiles of a statistic of units that are drawn with replacement.
template <class Statistic>
std::array<double, 2> bootstrap(const std::vector<const PreviewErrors::OfUnit*>& units,
                                const Statistic& statistic) {
  constexpr int repetitions = 400;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, units.size() - 1);
  std::vector<double> values;
  for (int k = 0; k < repetitions; ++k) {
    std::vector<const PreviewErrors::OfUnit*> drawn;
    for (std::size_t u = 0; u < units.size(); ++u) drawn.push_back(units[any(random)]);
    values.push_back(statistic(drawn));
  }
  std::sort(values.begin(), values.end());
  return {values[repetitions / 40], values[repetitions - 1 - repetitions / 40]};
}

void print_sums(std::string_view title, const Sums& sums) {
  if (sums.count == 0) return;
  fmt::print("    {:<16} {:>8.0f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f}\n", title, sums.count, 100 * sums.rms(),
             100 * sums.median(), 100 * sums.bias / sums.count, 100 * std::sqrt(sums.noise / sums.count));
}

std::string_view title_of(std::size_t place) {
  return place < unit_places.size() ? unit_places[place] : "all";
}

}  // namespace

void Sums::add(double error, double noise_squared) {
  ++count;
  bias += error;
  squares += error * error;
  noise += noise_squared;
  absolute.push_back(std::abs(error));
}

double Sums::rms() const {
  return std::sqrt(std::max(0.0, (squares - noise) / count));
}

double Sums::median() const {
  std::vector<double> sorted = absolute;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

PreviewErrors preview_errors(const Scene& scene, const std::vector<PlacedUnit>& units,
                             const std::vector<Preview>& previews, const SignalMatrix& truth) {
  PreviewErrors errors;
  for (std::size_t j = 0; j < units.size(); ++j) {
    PreviewErrors::OfUnit& unit = errors.units.emplace_back();
    unit.place = units[j].place;
    for (std::size_t i = 0; i < scene.labels.size(); ++i) {
      const double requirement = scene.requirement_of(scene.labels[i]);
      const std::size_t e = i * truth.columns() + j;
      const double mean = static_cast<double>(truth.mean[e]) / requirement,
                   noise = static_cast<double>(truth.standard_error[e]) / requirement,
                   error = static_cast<double>(previews[j].signal[i]) / requirement - mean,
                   stated = static_cast<double>(previews[j].error[i]) / requirement;
      for (const std::size_t place : {unit.place, unit_places.size()}) {
        errors.all[place].add(error, noise * noise);
        if (mean >= 0.5 && mean <= 2) errors.near[place].add(error, noise * noise);
      }
      unit.ratios.push_back(std::abs(error) / std::hypot(stated, noise));
      unit.labels += 1;
      unit.inside += unit.ratios.back() <= within ? 1 : 0;
      unit.doubtful += previews[j].doubts[i] != 0 ? 1 : 0;
    }
  }
  return errors;
}

void print_errors(const PreviewErrors& errors) {
  fmt::print("  errors, % of the requirement      rms   median     bias    noise of the truth\n");
  for (std::size_t place = 0; place < errors.all.size(); ++place)
    print_sums(title_of(place), errors.all[place]);
  fmt::print("  the same for labels at 0.5 to 2 requirements\n");
  for (std::size_t place = 0; place < errors.near.size(); ++place)
    print_sums(title_of(place), errors.near[place]);

  std::vector<double> ratios;
  const std::size_t half = errors.units.size() / 2;
  for (std::size_t j = 0; j < half; ++j)
    ratios.insert(ratios.end(), errors.units[j].ratios.begin(), errors.units[j].ratios.end());
  const auto at = ratios.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(ratios.size()));
  std::nth_element(ratios.begin(), at, ratios.end());
  fmt::print("  stated errors: first half of the units, factor for 95 %: {:.2f}; second half, % inside\n",
             *at / within);
  for (std::size_t place = 0; place <= unit_places.size(); ++place) {
    std::vector<const PreviewErrors::OfUnit*> some;
    double labels = 0, doubtful = 0;
    for (std::size_t j = half; j < errors.units.size(); ++j)
      if (place == unit_places.size() || errors.units[j].place == place) {
        some.push_back(&errors.units[j]);
        labels += errors.units[j].labels;
        doubtful += errors.units[j].doubtful;
      }
    if (some.empty()) continue;
    const auto [low, high] = bootstrap(some, inside_share);
    fmt::print("    {:<16} {:>8.1f}   ({:.1f} to {:.1f}); doubtful {:.1f} %\n", title_of(place),
               100 * inside_share(some), 100 * low, 100 * high, 100 * doubtful / labels);
  }
}

void ShopErrors::Counts::operator+=(const Counts& other) {
  all += other.all;
  sure += other.sure;
  inside += other.inside;
  inside_if_wrong += other.inside_if_wrong;
  error += other.error;
  mean += other.mean;
}

void ShopErrors::Counts::print(std::string_view title) const {
  if (sure == 0) {
    fmt::print("    {:<26} {:>18.1f}\n", title, 100.0);  // all in doubt
    return;
  }
  fmt::print("    {:<26} {:>7.1f} {:>10.1f} {:>10.2f} {:>15.1f}\n", title, 100 * inside / sure,
             100 * (1 - sure / all), 100 * error / mean, 100 * inside_if_wrong / sure);
}

void ShopErrors::add(const PreviewShop& shop, const std::vector<PlacedUnit>& units,
                     const std::vector<Preview>& previews, const SignalMatrix& truth) {
  std::array<Counts, unit_places.size()> counts;
  for (std::size_t j = 0; j < units.size(); ++j)
    for (std::size_t i = 0; i < shop.scene.labels.size(); ++i) {
      Counts& of = counts[units[j].place];
      ++of.all;
      if (previews[j].doubts[i] != 0) continue;
      const std::size_t e = i * truth.columns() + j;
      const auto signal = static_cast<double>(previews[j].signal[i]),
                 mean = static_cast<double>(truth.mean[e]);
      const double allowed = within * std::hypot(static_cast<double>(previews[j].error[i]),
                                                 static_cast<double>(truth.standard_error[e]));
      ++of.sure;
      of.inside += std::abs(signal - mean) <= allowed ? 1 : 0;
      of.inside_if_wrong += std::abs(too_high * signal - mean) <= allowed ? 1 : 0;
      of.error += signal - mean;
      of.mean += mean;
    }
  if (by_place_.back().all == 0)
    fmt::print("  {:<26} {:>7} {:>10} {:>10} {:>15}\n", "of the signals, %", "inside", "in doubt", "bias",
               "inside if wrong");
  Counts whole;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    by_place_[place] += counts[place];
    whole += counts[place];
  }
  by_place_.back() += whole;
  fmt::print("  {}\n", shop.name);
  for (std::size_t place = 0; place < counts.size(); ++place) counts[place].print(unit_places[place]);
  whole.print("all");
}

void ShopErrors::print() {
  fmt::print("  all shops\n");
  for (std::size_t place = 0; place < by_place_.size(); ++place) by_place_[place].print(title_of(place));
}

void RefinementErrors::add(const UnitRefinement& refinement, const SignalMatrix& truth, std::size_t unit) {
  constexpr double too_high = 1.03, relevant = 0.1;
  double precise = 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < scene_.labels.size(); ++i) {
    const double requirement = scene_.requirement_of(scene_.labels[i]);
    const std::size_t e = i * truth.columns() + unit;
    const double signal = static_cast<double>(refinement.signal(i)),
                 error = static_cast<double>(refinement.standard_error(i)),
                 mean = static_cast<double>(truth.mean[e]),
                 noise = static_cast<double>(truth.standard_error[e]);
    if (error <= target * requirement) ++precise;
    errors.push_back(error / requirement);
    const double spread = std::hypot(error, noise);
    if (!(spread > 0)) continue;
    const double z = (signal - mean) / spread;
    squares_ += z * z;
    beyond_ += std::abs(z) > 3 ? 1 : 0;
    ++count_;
    if (mean < relevant * requirement) continue;
    const double wrong = (signal * too_high - mean) / spread;
    control_squares_ += wrong * wrong;
    ++control_count_;
  }
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errors.size()));
  std::nth_element(errors.begin(), at, errors.end());
  largest_.push_back(*at);
  shares_.push_back(precise / static_cast<double>(scene_.labels.size()));
  batches_ += refinement.most_batches();
}

void RefinementErrors::print() const {
  std::vector<double> sorted = shares_;
  std::sort(sorted.begin(), sorted.end());
  const auto units = static_cast<double>(sorted.size());
  fmt::print(
      "  z-scores of {:.0f} signals: rms {:.3f}, beyond 3: {:.2f} %; control, 3 % too high: rms {:.3f}\n",
      count_, std::sqrt(squares_ / count_), 100 * beyond_ / count_,
      std::sqrt(control_squares_ / control_count_));
  fmt::print(
      "  labels within {:g} % of the requirement: median unit {:.1f} %, worst {:.1f} %; 99 % of them in "
      "{:.0f} "
      "of {:.0f} units; {:.0f} batches at most, on average\n",
      100 * target, 100 * sorted[sorted.size() / 2], 100 * sorted.front(),
      static_cast<double>(std::count_if(sorted.begin(), sorted.end(), [](double s) { return s >= 0.99; })),
      units, batches_ / units);
  std::vector<double> largest = largest_;
  std::sort(largest.begin(), largest.end());
  const double middle = largest[largest.size() / 2];
  fmt::print(
      "  error of 99 % of the labels: {:.1f} % of the requirement for the median unit, so 1 % takes {:.0f} "
      "times as long\n",
      100 * middle, std::pow(middle / target, 2));
}

}  // namespace shelfbeam::bench
