#include "shelfbeam/report/mounting/tolerance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

namespace {

constexpr double steps[] = {0.05, 0.1, 0.2, 0.3, 0.5};  // m
constexpr double in_line = 1e-3;                        // m, and in the axis

// The nearest alike candidates towards -x, +x, -y and +y; nothing unless there are all four.
struct Neighbours {
  struct One {
    std::uint32_t column = 0;
    double distance = HUGE_VAL;
  };
  std::array<One, 4> all;

  bool are_complete() const {
    return std::all_of(all.begin(), all.end(), [](const One& one) { return one.distance <= max_neighbour; });
  }
};

Neighbours neighbours_of(const SignalMatrix& matrix, std::uint32_t column) {
  Neighbours found;
  const TransceiverColumn& unit = matrix.transceivers[column];
  for (std::uint32_t j = 0; j < matrix.columns(); ++j) {
    const TransceiverColumn& other = matrix.transceivers[j];
    const Vec3 way = other.position - unit.position;
    if (j == column || other.type != unit.type || std::abs(way.z) > in_line ||
        length(other.axis - unit.axis) > in_line)
      continue;
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(way[1 - axis]) > in_line) continue;
      const std::size_t first = axis == 0 ? 0 : 2;
      Neighbours::One& one = found.all[first + (way[axis] > 0 ? 1U : 0U)];
      const double distance = std::abs(way[axis]);
      if (distance > in_line && distance < one.distance) one = {j, distance};
    }
  }
  return found;
}

// Per label, the loss of a unit's signal per metre in its worst direction.
std::vector<float> losses_of(const SignalMatrix& matrix, std::uint32_t column, const Neighbours& neighbours) {
  std::vector<float> losses(matrix.rows());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    std::array<double, 2> along{};
    for (std::size_t k = 0; k < neighbours.all.size(); ++k) {
      const auto& [other, distance] = neighbours.all[k];
      const double loss = (matrix.signal(i, column) - matrix.signal(i, other)) / distance;
      along[k / 2] = std::max(along[k / 2], loss);
    }
    losses[i] = static_cast<float>(std::hypot(along[0], along[1]));
  }
  return losses;
}

/// The signals of the chosen units at all labels, each unit off by its tolerance.
class Shifted {
 public:
  explicit Shifted(const ReportInput& input)
      : matrix_(input.matrix),
        placement_(input.plan.placement),
        losses_(placement_.selected.size()),
        tolerances_(placement_.selected.size(), 0.0),
        least_(matrix_.rows()),
        reached_(matrix_.rows()) {
    for (std::size_t k = 0; k < losses_.size(); ++k) {
      const std::uint32_t column = placement_.selected[k];
      if (matrix_.transceivers[column].installed) continue;
      const Neighbours neighbours = neighbours_of(matrix_, column);
      if (neighbours.are_complete()) losses_[k] = losses_of(matrix_, column, neighbours);
    }
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      least_[i] = received(i);
      reached_[i] = is_met(least_[i], matrix_.labels[i].requirement);
    }
  }

  // Each step for all units before the next one, so that none takes the reserve of the others.
  std::vector<double> tolerances() {
    for (const double step : steps)
      for (std::size_t k = 0; k < tolerances_.size(); ++k) {
        if (losses_[k].empty()) continue;
        const double before = tolerances_[k];
        tolerances_[k] = step;
        if (!holds_for(k, step - before)) tolerances_[k] = before;
      }
    return tolerances_;
  }

 private:
  double signal(std::size_t label, std::size_t k) const {
    const double whole = matrix_.signal(label, placement_.selected[k]);
    if (losses_[k].empty()) return whole;
    return std::max(0.0, whole - loss(label, k, tolerances_[k]));
  }

  double received(std::size_t label) const {
    ReceivedSignal sum(placement_.problem);
    for (std::size_t k = 0; k < losses_.size(); ++k) sum.add(signal(label, k));
    return sum.value();
  }

  double loss(std::size_t label, std::size_t k, double metres) const {
    return loss_factor * static_cast<double>(losses_[k][label]) * metres;
  }

  // Whether all labels stay reached when the tolerance of a unit has grown by `more`. The signal of a label
  // falls by no more than that of the unit, so few labels need a sum over all units.
  bool holds_for(std::size_t k, double more) {
    for (std::size_t i = 0; i < reached_.size(); ++i)
      if (reached_[i] && !is_met(least_[i] - loss(i, k, more), matrix_.labels[i].requirement) &&
          !is_met(received(i), matrix_.labels[i].requirement))
        return false;
    for (std::size_t i = 0; i < reached_.size(); ++i) least_[i] = std::max(0.0, least_[i] - loss(i, k, more));
    return true;
  }

  const SignalMatrix& matrix_;
  const Placement& placement_;
  std::vector<std::vector<float>> losses_;  // empty: the unit does not move
  std::vector<double> tolerances_;
  std::vector<double> least_;  // per label: no more than its received signal
  std::vector<bool> reached_;
};

}  // namespace

std::vector<double> tolerances_of(const ReportInput& input) {
  if (input.plan.availability) return std::vector<double>(input.plan.placement.selected.size(), 0.0);
  return Shifted(input).tolerances();
}

}  // namespace shelfbeam
