#include "known_shop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/transport/zoo.hpp"

namespace shelfbeam::bench {

namespace {

namespace fs = std::filesystem;

// No shop has a symmetry, because equally good selections would make every plan undecided between them.
struct Plan {
  std::string_view name;
  std::size_t units = 0;  ///< the number that tight requirements suit
  test::ZooStore store;
};

Plan plan_of(const std::string& name) {
  const nlohmann::json goods{{"goods", "goods"}};
  if (name == "low")  // labels a hand's breadth above the floor, under a low ceiling
    return {"low", 3,
            test::ZooStore(5, 4, 2.3, 0.7)
                .paint("goods", 0.5)
                .paint("floor", 0.4)
                .cover("floor", "floor")
                .shelves(0.9, 0.65, 1.8, 1.4, {0.07, 0.15, 0.5}, 0.9, "walls", goods)
                .shelves(1.9, 2.4, 1.6, 1.2, {0.1, 0.5}, 0.8, "walls", goods)
                .grid(4, 3, 2.2)};
  if (name == "aisles")  // high shelves that separate aisles
    return {"aisles", 4,
            test::ZooStore(8, 6.5, 3, 0.4)
                .paint("goods", 0.3)
                .shelves(1.1, 1.3, 2.1, 2.1, {0.4, 1.3}, 1.4, "walls", goods)
                .shelves(4.6, 1.5, 2.3, 2.2, {0.9}, 1.6, "walls", goods)
                .shelves(1.3, 3.9, 2.2, 2.2, {0.6, 1.5}, 1.5, "walls", goods)
                .shelves(4.9, 4.2, 2.0, 2.1, {0.3}, 1.3, "walls", goods)
                .grid(5, 3, 2.9)};
  if (name == "high")  // a hall with low shelves
    return {"high", 2,
            test::ZooStore(7, 5, 4.5, 0.6)
                .paint("goods", 0.4)
                .shelves(1.2, 1.1, 3.1, 1.3, {0.3, 0.8}, 1.2, "walls", goods)
                .shelves(2.3, 3.3, 2.7, 1.5, {0.2, 1.0}, 1.1, "walls", goods)
                .grid(4, 3, 4.4)};
  if (name ==
      "back") {  // the best selections have a unit in a back room, which shines on an aisle through a door
    test::ZooStore store(7, 5, 3, 0.7);
    store.paint("goods", 0.5)
        .inner_wall({4.4, 3.1}, {7, 3.1}, 0.5)
        .inner_wall({4.4, 3.1}, {4.4, 5})
        .box({3.9, 1.7, 0}, {7, 2, 2.7}, "goods");
    for (const auto& [x, z] : {std::pair(4.5, 0.4), {5.3, 1.1}, {6.2, 0.6}, {6.7, 1.3}})
      store.label({x, 2.01, z}, {0, 1, 0});
    for (const auto& [x, z] : {std::pair(4.4, 0.5), {5.6, 1.0}, {6.5, 0.4}})
      store.label({x, 1.69, z}, {0, -1, 0});
    for (const auto& [y, z] : {std::pair(0.7, 0.4), {1.9, 1.2}, {3.2, 0.5}, {4.3, 0.9}})
      store.label({0.01, y, z}, {1, 0, 0});
    store.label({2.5, 4.99, 0.6}, {0, -1, 0}).unit({5.3, 3.9, 2.9}).unit({6.4, 4.3, 2.9});
    for (const auto& [x, y] :
         {std::pair(1.2, 1.1), {2.9, 0.9}, {1.5, 3.7}, {3.2, 3.4}, {2.2, 2.3}, {6.3, 0.9}})
      store.unit({x, y, 2.9});
    return {"back", 3, store};
  }
  throw std::invalid_argument("unknown shop " + name);
}

SignalMatrix simulated(const std::string& name, const fs::path& file, std::uint64_t samples) {
  if (!fs::exists(file)) {
    SimulationOptions options;
    options.estimator = EstimatorKind::uniform;
    options.strategy = Strategy::nee;
    options.direct = DirectLight::exact;
    options.samples = samples;
    options.seed = 0;  // no plan uses it
    simulate_to_file(make_scene(parse_store(plan_of(name).store.requirement(1).text(), name, ".")), options,
                     file);
  }
  return read_signal_file(file);
}

// Every third unit is cheap.
double price_of(std::size_t column) {
  return column % 3 == 1 ? 62.5 : 100;
}

}  // namespace

std::vector<KnownProblem> known_problems() {
  return {{"plain", true, false, {}},
          {"single", false, false, {"--model", "non-cooperative"}},
          {"weighted", true, true, {"--weighted"}},
          {"lexicographic", true, false, {"--objective", "signal"}}};
}

KnownShop::KnownShop(const fs::path& folder, const std::string& name, std::uint64_t samples)
    : name_(name), folder_(folder), prices_file_(folder / fmt::format("{}-prices.csv", name)) {
  fs::create_directories(folder);
  reference_ = simulated(name, folder / fmt::format("{}-{}.h5", name, samples), samples);
  std::string prices = "id,cost\n";
  for (std::size_t j = 0; j < reference_.columns(); ++j)
    prices += fmt::format("{},{}\n", reference_.transceivers[j].id, price_of(j));
  write_file(prices_file_, prices);
}

KnownShop::Sum KnownShop::sum(const KnownProblem& problem, double requirement, std::size_t label,
                              std::span<const std::size_t> selected) const {
  Sum found;
  for (const std::size_t j : selected) {
    const auto signal = static_cast<double>(reference_.mean[reference_.at(label, j)]);
    const auto error = static_cast<double>(reference_.standard_error[reference_.at(label, j)]);
    if (problem.adds_up) {
      found.signal += signal;
      found.error += error;
    } else if (signal > found.signal) {
      found.signal = signal;
      found.error = error;
    }
  }
  found.is_clear = std::abs(found.signal - requirement) > 3 * found.error;
  found.is_reached = is_met(found.signal, requirement);
  return found;
}

double KnownShop::cost(const KnownProblem& problem, std::span<const std::size_t> selected) const {
  double cost = 0;
  for (const std::size_t j : selected) cost += problem.has_prices ? price_of(j) : 1;
  return cost;
}

// All selections, because this also tests the program's search.
std::vector<KnownShop::Best> KnownShop::selections(const KnownProblem& problem) const {
  const std::size_t n = reference_.columns(), m = reference_.rows();
  std::vector<Best> all;
  std::vector<std::size_t> selected;
  for (std::uint32_t mask = 1; mask < std::uint32_t{1} << n; ++mask) {
    selected.clear();
    for (std::size_t j = 0; j < n; ++j)
      if ((mask >> j & 1U) != 0) selected.push_back(j);
    Best one{std::numeric_limits<double>::infinity(), cost(problem, selected), selected.size()};
    for (std::size_t i = 0; i < m; ++i)
      one.signal = std::min(one.signal, sum(problem, 1, i, selected).signal);
    all.push_back(one);
  }
  return all;
}

// The largest requirement that selections of this many units meet; with prices, that selections meet which
// cost no more than the cheapest ones of this many units between their largest requirement and that of fewer.
double KnownShop::critical(const KnownProblem& problem, std::size_t units) const {
  const std::vector<Best> all = selections(problem);
  const auto best = [&](const auto& is_allowed) {
    double signal = 0;
    for (const Best& one : all)
      if (is_allowed(one)) signal = std::max(signal, one.signal);
    return signal;
  };
  const double of_count = best([&](const Best& one) { return one.count <= units; });
  if (!problem.has_prices) return of_count;
  const double of_fewer = best([&](const Best& one) { return one.count < units; });
  const double cost = case_of(problem, std::sqrt(of_count * of_fewer)).cost;
  return best([&](const Best& one) { return one.cost <= cost; });
}

KnownShop::Case KnownShop::case_of(const KnownProblem& problem, double requirement) const {
  Case found;
  found.requirement = requirement;
  found.cost = std::numeric_limits<double>::infinity();
  for (const Best& one : selections(problem)) {
    if (!is_met(one.signal, requirement) || one.cost >= found.cost) continue;
    found.cost = one.cost;
    found.count = one.count;
  }
  if (!std::isfinite(found.cost)) throw std::runtime_error("no selection meets the requirement");
  return found;
}

KnownShop::Case KnownShop::with_file(const KnownProblem& problem, double requirement) const {
  Case found = case_of(problem, requirement);
  found.store = folder_ / fmt::format("{}-{:.8g}.json", name_, requirement);
  write_file(found.store, plan_of(name_).store.requirement(requirement).text());
  return found;
}

KnownShop::Case KnownShop::with_margin(const KnownProblem& problem, double margin) const {
  return with_file(problem, critical(problem, plan_of(name_).units) / (1 + margin));
}

// Costs in ascending order, and the requirement that each can meet at the most, in steps.
KnownShop::Case KnownShop::loose(const KnownProblem& problem) const {
  std::vector<Best> all = selections(problem);
  std::sort(all.begin(), all.end(), [](const Best& a, const Best& b) { return a.cost < b.cost; });
  const std::size_t max_units = plan_of(name_).units + 1;
  double reached = 0, widest = 1, requirement = 0;
  for (std::size_t k = 0; k < all.size();) {
    const double cost = all[k].cost, before = reached;
    std::size_t units = 0;
    for (; k < all.size() && all[k].cost == cost; ++k) {
      reached = std::max(reached, all[k].signal);
      units = std::max(units, all[k].count);
    }
    if (before == 0 || units < 2 || units > max_units || reached / before <= widest) continue;
    widest = reached / before;
    requirement = std::sqrt(reached * before);
  }
  return with_file(problem, requirement);
}

}  // namespace shelfbeam::bench
