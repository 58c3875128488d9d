#include "low_shop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/transport/zoo.hpp"

namespace shelfbeam::bench {

namespace {

namespace fs = std::filesystem;

// The shop has no symmetry, because equally good selections would make every plan undecided between them.
// There are two labels per board.
std::string store_text(double requirement) {
  const nlohmann::json goods{{"goods", "goods"}};
  return test::ZooStore(5, 4, 2.3, 0.7)
      .paint("goods", 0.5)
      .paint("floor", 0.4)
      .cover("floor", "floor")
      .shelves(0.9, 0.65, 1.8, 1.4, {0.07, 0.15, 0.5}, 0.9, "walls", goods)
      .shelves(1.9, 2.4, 1.6, 1.2, {0.1, 0.5}, 0.8, "walls", goods)
      .requirement(requirement)
      .grid(4, 3, 2.2)
      .text();
}

SignalMatrix simulated(const fs::path& file, std::uint64_t samples) {
  if (!fs::exists(file)) {
    SimulationOptions options;
    options.estimator = EstimatorKind::uniform;
    options.strategy = Strategy::nee;
    options.direct = DirectLight::exact;
    options.samples = samples;
    options.seed = 0;  // no plan uses it
    simulate_to_file(make_scene(parse_store(store_text(1), "low shop", ".")), options, file);
  }
  return read_signal_file(file);
}

// Calls body(selection) for every selection of `count` of n columns.
template <class Body>
void for_each_selection(std::size_t n, std::size_t count, const Body& body) {
  std::vector<std::size_t> selected;
  const auto extend = [&](const auto& self, std::size_t first) -> void {
    if (selected.size() == count) return body(selected);
    for (std::size_t j = first; j < n; ++j) {
      selected.push_back(j);
      self(self, j + 1);
      selected.pop_back();
    }
  };
  extend(extend, 0);
}

}  // namespace

LowShop::LowShop(const fs::path& folder, std::uint64_t samples)
    : file_(folder / fmt::format("shop-{}.json", samples)) {
  fs::create_directories(folder);
  reference_ = simulated(folder / fmt::format("shop-{}.h5", samples), samples);
  choose_requirement();
  check();
  write_file(file_, store_text(requirement_));
}

LowShop::Sum LowShop::sum(std::size_t label, std::span<const std::size_t> selected) const {
  Sum found;
  for (const std::size_t j : selected) {
    found.signal += static_cast<double>(reference_.mean[reference_.at(label, j)]);
    found.error += static_cast<double>(reference_.standard_error[reference_.at(label, j)]);
  }
  found.is_clear = std::abs(found.signal - requirement_) > 3 * found.error;
  found.is_reached = is_met(found.signal, requirement_);
  return found;
}

// Enumerates all selections, because this also tests the program's search.
void LowShop::choose_requirement() {
  const auto min_margin_of = [&](const std::vector<std::size_t>& selected) {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < reference_.rows(); ++i) worst = std::min(worst, sum(i, selected).signal);
    return worst;
  };
  double best_margin = 0, max_of_fewer = 0;
  for_each_selection(reference_.columns(), units, [&](const std::vector<std::size_t>& selected) {
    if (min_margin_of(selected) <= best_margin) return;
    best_margin = min_margin_of(selected);
    best_ = selected;
  });
  for_each_selection(reference_.columns(), units - 1, [&](const std::vector<std::size_t>& selected) {
    max_of_fewer = std::max(max_of_fewer, min_margin_of(selected));
  });
  requirement_ = 0.99 * best_margin;
  margin_ = best_margin / requirement_ - 1;
  margin_of_fewer_ = max_of_fewer / requirement_ - 1;
  for (LabelRow& label : reference_.labels) label.requirement = requirement_;
}

void LowShop::check() const {
  const auto refuse = [](const char* what) {
    throw std::runtime_error(fmt::format("the reference is too short to show that {}", what));
  };
  for (std::size_t i = 0; i < reference_.rows(); ++i)
    if (const Sum found = sum(i, best_); !found.is_clear || !found.is_reached)
      refuse("its best selection suffices");
  for_each_selection(reference_.columns(), units - 1, [&](const std::vector<std::size_t>& selected) {
    for (std::size_t i = 0; i < reference_.rows(); ++i)
      if (const Sum found = sum(i, selected); found.is_clear && !found.is_reached) return;
    refuse("fewer units do not suffice");
  });
  const Placement placed = place(make_signal_table(reference_), {}, {});
  if (placed.status != Status::optimal || placed.count() != units)
    throw std::runtime_error("the search does not find the optimum of the enumeration");
}

}  // namespace shelfbeam::bench
