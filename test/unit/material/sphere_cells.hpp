#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::test {

/// The sphere of directions, divided into cells with the integral of a function over each. Cells are small
/// where the function varies. Coordinates are theta and v in [-1, 1], azimuth = plane + pi v^5: a lobe at
/// grazing angles is as narrow as 0.001 rad across its plane of incidence.
class SphereCells {
 public:
  /// Splits a cell until Gauss's rule of 4 x 4 points changes by less than `tolerance`; `plane` is the
  /// azimuth near which the function is narrow.
  template <class Function>
  SphereCells(double plane, const Function& function, double tolerance = 2e-6) : plane_(plane) {
    for (std::size_t i = 0; i < rings; ++i)
      for (std::size_t j = 0; j < sectors; ++j) {
        const Cell cell{step(i, rings) * pi, step(i + 1, rings) * pi, 2 * step(j, sectors) - 1,
                        2 * step(j + 1, sectors) - 1};
        cells_.push_back(cell);
        cells_.back().integral = gauss(cells_.back(), function);
      }
    for (std::size_t k = 0; k < rings * sectors; ++k) split(k, function, tolerance, 0);
    for (Cell& cell : cells_)
      if (cell.children == 0) {
        cell.leaf = integrals_.size();
        integrals_.push_back(cell.integral);
      }
  }

  const std::vector<double>& integrals() const { return integrals_; }
  double integral() const { return std::accumulate(integrals_.begin(), integrals_.end(), 0.0); }

  /// The index in `integrals` of the direction's cell.
  std::size_t cell_of(const Vec3& d) const {
    const double theta = std::atan2(std::hypot(d.x, d.y), d.z);
    double turn = std::atan2(d.y, d.x) - plane_;
    turn -= 2 * pi * std::round(turn / (2 * pi));
    const double v = std::copysign(std::pow(std::abs(turn) / pi, 0.2), turn);
    const auto index = [](double x, std::size_t n) {
      return std::min(n - 1, static_cast<std::size_t>(x * static_cast<double>(n)));
    };
    std::size_t k = index(theta / pi, rings) * sectors + index((v + 1) / 2, sectors);
    while (cells_[k].children != 0) {
      const Cell& c = cells_[k];
      k = c.children + (theta < (c.theta0 + c.theta1) / 2 ? 0 : 2) + (v < (c.v0 + c.v1) / 2 ? 0 : 1);
    }
    return cells_[k].leaf;
  }

 private:
  struct Cell {
    double theta0, theta1, v0, v1;
    double integral = 0;
    std::size_t children = 0;  // the first of four; 0 for a leaf
    std::size_t leaf = 0;
  };

  static constexpr std::size_t rings = 50, sectors = 24;  // the horizon is a border

  static double step(std::size_t k, std::size_t n) { return static_cast<double>(k) / static_cast<double>(n); }

  template <class Function>
  double gauss(const Cell& c, const Function& function) const {
    constexpr std::array<double, 4> node{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                         0.9305681557970263};
    constexpr std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                           0.1739274225687269};
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = c.v0 + node[j] * (c.v1 - c.v0), v2 = v * v;
      const double azimuth = plane_ + pi * v2 * v2 * v, cos = std::cos(azimuth), sin = std::sin(azimuth);
      for (std::size_t i = 0; i < 4; ++i) {
        const double theta = c.theta0 + node[i] * (c.theta1 - c.theta0), across = std::sin(theta);
        sum += weight[i] * weight[j] * function(Vec3{across * cos, across * sin, std::cos(theta)}) * across *
               5 * pi * v2 * v2;
      }
    }
    return sum * (c.theta1 - c.theta0) * (c.v1 - c.v0);
  }

  template <class Function>
  void split(std::size_t k, const Function& function, double tolerance, int depth) {
    const Cell whole = cells_[k];
    const double theta = (whole.theta0 + whole.theta1) / 2, v = (whole.v0 + whole.v1) / 2;
    std::array<Cell, 4> parts{Cell{whole.theta0, theta, whole.v0, v}, Cell{whole.theta0, theta, v, whole.v1},
                              Cell{theta, whole.theta1, whole.v0, v}, Cell{theta, whole.theta1, v, whole.v1}};
    double sum = 0;
    for (Cell& part : parts) sum += part.integral = gauss(part, function);
    if (depth == 12 || std::abs(sum - whole.integral) <= tolerance) {
      cells_[k].integral = sum;
      return;
    }
    const std::size_t first = cells_[k].children = cells_.size();
    cells_.insert(cells_.end(), parts.begin(), parts.end());
    for (std::size_t child = 0; child < 4; ++child) split(first + child, function, tolerance, depth + 1);
  }

  double plane_;
  std::vector<Cell> cells_;
  std::vector<double> integrals_;
};

}  // namespace shelfbeam::test
