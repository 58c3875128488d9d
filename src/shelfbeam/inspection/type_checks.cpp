#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/device/responsivity.hpp"
#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// The largest mean intensity over phi, sampled every degree.
double peak_intensity(const Emission& emission) {
  double peak = 0;
  for (int degree = 0; degree <= 180; ++degree)
    peak = std::max(peak, mean_intensity(emission, radians(degree)));
  return peak;
}

// Three digits, without an exponent up to a million.
std::string plain(double value) {
  return value >= 100 && value < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

// Distances at which one unit alone meets a requirement by direct light, m.
struct Range {
  std::string unit;
  double peak = 0;  // in the unit's strongest direction
  double mean = 0;  // at the intensity of the same flux spread over a hemisphere
};

// A unit is typically heard this far, also in a smaller shop, m.
constexpr double usual_range = 10;

class TypeChecks {
 public:
  TypeChecks(const Inspected& store, WarningList& warnings)
      : file_(store.store.file),
        shared_(store.store.shared),
        scene_(store.scene),
        farthest_(std::max(usual_range, length(store.scene.upper - store.scene.lower))),
        warnings_(warnings),
        labels_(scene_.label_types.size()),
        units_(scene_.transceiver_types.size()),
        new_units_(units_.size()) {
    for (const Label& label : scene_.labels) ++labels_[label.type.value];
    for (const Transceiver& unit : scene_.transceivers) {
      ++units_[unit.type.value];
      new_units_[unit.type.value] += unit.installed ? 0 : 1;
    }
    double peak = 0;
    for (std::size_t k = 0; k < units_.size(); ++k) {
      const TransceiverType& unit = scene_.transceiver_types[k];
      if (units_[k] == 0 || peak_intensity(unit.emission) <= peak) continue;
      peak = peak_intensity(unit.emission);
      strongest_ = &unit;
    }
  }

  void check() {
    for (std::size_t k = 0; k < labels_.size(); ++k) {
      const LabelType& type = scene_.label_types[k];
      if (labels_[k] == 0) {
        if (k >= shared_.label_types) unused("label_types", type.name, "no label has it");
        continue;
      }
      check_requirement(type);
      check_label(type);
    }
    for (std::size_t k = 0; k < units_.size(); ++k) {
      const TransceiverType& type = scene_.transceiver_types[k];
      if (units_[k] > 0)
        check_unit(type, k);
      else if (k >= shared_.transceiver_types)
        unused("transceiver_types", type.name, "no candidate has it");
    }
    compare_requirements();
    compare_flux();
  }

 private:
  std::string at(std::string_view section, const std::string& name, std::string_view key = {}) const {
    return fmt::format("{}: {}.{}{}", file_, section, name, key);
  }

  void unused(std::string_view section, const std::string& name, std::string_view why) {
    warnings_.add(FindingCode::type_unused, at(section, name),
                  "{}; remove it, or correct the 'type' of the devices that should have it", why);
  }

  // `threshold`: with or without the safety factor.
  Range range(const LabelType& type, double threshold) const {
    if (strongest_ == nullptr) return {};
    const double ahead = largest(type.responsivity);
    return {strongest_->name, std::sqrt(peak_intensity(strongest_->emission) * ahead / threshold),
            std::sqrt(power(strongest_->emission) / (2 * pi) * ahead / threshold)};
  }

  void check_requirement(const LabelType& type) {
    const Range range = this->range(type, type.requirement());
    // 1000 times as much signal is about 32 times as much distance.
    const double thousand = std::sqrt(1000.0);
    const auto is_usual = [&](double distance) { return distance > 1 && distance < 3 * farthest_; };
    const bool is_prefix = is_usual(range.peak / thousand) || is_usual(range.peak * thousand);
    const std::string_view remedy =
        is_prefix
            ? "milliwatts and watts may be confused: thresholds are in W/m^2, flux in W, intensity in W/sr"
            : "check 'threshold', 'safety_factor' and the emission of the transceiver";
    if (type.range_m > farthest_ || (type.range_m > 0 && type.range_m < 1))
      warnings_.add(FindingCode::requirement, at("label_types", type.name, ".threshold"),
                    "the label receives signals at {} m; 3 to 20 m are typical, in this shop up to {} "
                    "m; check 'at_m'",
                    plain(type.range_m), plain(farthest_));
    // A narrow beam may reach farther than the room; its mean then does not.
    else if (range.peak > farthest_ && range.mean > farthest_ / 2)
      warnings_.add(FindingCode::requirement, at("label_types", type.name),
                    "a single '{}' meets the requirement of {} W/m^2 from {} m; 3 to 20 m are typical, in "
                    "this shop up to {} m; {}",
                    range.unit, plain(type.requirement()), plain(range.peak), plain(farthest_), remedy);
    else if (range.peak < 1)
      warnings_.add(FindingCode::requirement, at("label_types", type.name),
                    "a single '{}' meets the requirement of {} W/m^2 only up to {} m, and no other unit "
                    "farther; 3 to 20 m are typical; {}",
                    range.unit, plain(type.requirement()), plain(range.peak), remedy);
  }

  void check_label(const LabelType& type) {
    constexpr double largest = 0.6;
    if (std::max(type.size[0], type.size[1]) > largest)
      warnings_.add(FindingCode::label_size, at("label_types", type.name, ".size"),
                    "is {} x {} m; 0.03 to 0.3 m are typical; correct it", plain(type.size[0]),
                    plain(type.size[1]));
    if (const auto* power = std::get_if<CosinePowerResponse>(&type.responsivity);
        power != nullptr && power->cutoff < radians(10))
      warnings_.add(FindingCode::label_response, at("label_types", type.name, ".responsivity.cutoff_deg"),
                    "is {}, so the label receives light only from straight ahead; 40 to 90 are "
                    "typical; give degrees, not radians",
                    plain(power->cutoff * 180 / pi));
  }

  // The shares of the flux within 4 degrees of the axis and behind the unit.
  static std::array<double, 2> shares(const Emission& emission) {
    constexpr int steps = 180, narrow = 4;
    double all = 0, ahead = 0, behind = 0;
    for (int degree = 0; degree < steps; ++degree) {
      const double theta = radians(degree + 0.5), part = mean_intensity(emission, theta) * std::sin(theta);
      all += part;
      if (degree < narrow) ahead += part;
      if (degree >= steps / 2) behind += part;
    }
    return {ahead / all, behind / all};
  }

  void check_directions(const TransceiverType& type) {
    const auto [ahead, behind] = shares(type.emission);
    const std::string where = at("transceiver_types", type.name, ".emission");
    if (ahead > 0.9)
      warnings_.add(FindingCode::emission_direction, where,
                    "all light leaves within 4 degrees of the axis; beams of 20 degrees and more are "
                    "typical; give angles in degrees, not radians");
    if (behind > 0.5)
      warnings_.add(FindingCode::emission_direction, where,
                    "{:.0f} % of the light leaves backwards, beyond 90 degrees from the axis; less than "
                    "half is typical; reverse the angles of the profile",
                    100 * behind);
  }

  void check_unit(const TransceiverType& type, std::size_t k) {
    check_directions(type);
    const double flux = power(type.emission);
    if (flux > 100 || flux < 1e-3)
      warnings_.add(FindingCode::flux, at("transceiver_types", type.name, ".emission"),
                    "emits {} W in total; 0.01 to 20 W are typical; check its flux or intensity, "
                    "which are in W and W/sr",
                    plain(flux));
    if (type.cost == 0 && new_units_[k] > 0)
      warnings_.add(FindingCode::unit_free, at("transceiver_types", type.name, ".cost"),
                    "is 0, so a plan may have many of them; a price above 0 is typical; "
                    "give a price");
    if (!type.has_cost && !scene_.currency.empty() && new_units_[k] > 0)
      warnings_.add(FindingCode::unit_free, at("transceiver_types", type.name),
                    "has no price and counts as 1 {}, because other types have prices; give a price",
                    scene_.currency);
  }

  // The smallest and the largest value of the used types.
  template <class Types, class Value>
  void compare(const Types& types, const std::vector<std::size_t>& used, std::string_view section,
               FindingCode code, std::string_view subject, std::string_view unit, Value value) {
    const auto* low = static_cast<decltype(&types[0])>(nullptr);
    const auto* high = low;
    for (std::size_t k = 0; k < types.size(); ++k) {
      if (used[k] == 0) continue;
      if (low == nullptr || value(types[k]) < value(*low)) low = &types[k];
      if (high == nullptr || value(types[k]) > value(*high)) high = &types[k];
    }
    if (low == nullptr || value(*high) < 50 * value(*low)) return;
    warnings_.add(
        code, at(section, low->name),
        "has a {} of {} {}, and '{}' one of {} {}; a factor below 10 is typical; check the units of "
        "measure of both",
        subject, plain(value(*low)), unit, high->name, plain(value(*high)), unit);
  }
  void compare_requirements() {
    compare(scene_.label_types, labels_, "label_types", FindingCode::requirement_ratio, "requirement",
            "W/m^2", [](const LabelType& type) { return type.requirement() / largest(type.responsivity); });
  }
  void compare_flux() {
    compare(scene_.transceiver_types, units_, "transceiver_types", FindingCode::flux_ratio, "flux", "W",
            [](const TransceiverType& type) { return power(type.emission); });
  }

  const std::string& file_;
  const NameCounts& shared_;
  const Scene& scene_;
  double farthest_;  // m, up to which a unit may be heard: the diagonal of the shop
  WarningList& warnings_;
  std::vector<std::size_t> labels_, units_, new_units_;  // by type
  const TransceiverType* strongest_ = nullptr;           // of those with units, in its strongest direction
};

}  // namespace

void warn_of_types(const Inspected& store, WarningList& warnings) {
  TypeChecks(store, warnings).check();
}

}  // namespace shelfbeam
