#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/operator/preview.hpp"
#include "shelfbeam/transport/operator/unit_refinement.hpp"

#include "preview_shops.hpp"
#include "random_units.hpp"

namespace shelfbeam::bench {

/// Errors of previews in shares of requirements, and how often their stated errors hold.
struct PreviewErrors {
  struct Sums {
    double count = 0, bias = 0, squares = 0, noise = 0;
    std::vector<double> absolute;

    void add(double error, double noise_squared);
    /// Root mean square without the noise of the truth.
    double rms() const;
    double median() const;
  };
  struct OfUnit {
    std::size_t place;
    double labels = 0, inside = 0, doubtful = 0;
    std::vector<double> ratios;  ///< |error| over the standard error of preview and truth
  };

  std::array<Sums, unit_places.size() + 1> all, near;  ///< by place, and pooled; near: 0.5 to 2 requirements
  std::vector<OfUnit> units;
};

PreviewErrors preview_errors(const Scene& scene, const std::vector<PlacedUnit>& units,
                             const std::vector<Preview>& previews, const SignalMatrix& truth);
void print_errors(const PreviewErrors& errors);

/// How often stated errors hold in some shops, for signals without doubt.
class ShopErrors {
 public:
  void add(const PreviewShop& shop, const std::vector<PlacedUnit>& units,
           const std::vector<Preview>& previews, const SignalMatrix& truth);
  void print();

 private:
  struct Counts {
    double all = 0, sure = 0, inside = 0, inside_if_wrong = 0, error = 0, mean = 0;

    void operator+=(const Counts& other);
    void print(std::string_view title) const;
  };
  static constexpr double too_high = 1.15;

  std::array<Counts, unit_places.size() + 1> by_place_;
};

/// Errors of refined columns.
class RefinementErrors {
 public:
  explicit RefinementErrors(const Scene& scene) : scene_(scene) {}

  static constexpr double target = 0.01;  ///< wanted standard error, share of the requirement

  void add(const UnitRefinement& refinement, const SignalMatrix& truth, std::size_t unit);
  void print() const;

 private:
  const Scene& scene_;
  double count_ = 0, precise_ = 0, squares_ = 0, beyond_ = 0, control_squares_ = 0, control_count_ = 0;
  double batches_ = 0;
  std::vector<double> shares_, largest_;  ///< by unit: labels with the wanted error; error of 99 %
};

}  // namespace shelfbeam::bench
