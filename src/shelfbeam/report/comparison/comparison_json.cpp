#include "shelfbeam/report/comparison/comparison_json.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json pair_json(const ComparisonInput& input, std::size_t k) {
  const ComparedPair& pair = input.pairs[k];
  const PairResult& result = input.comparison.pairs[k];
  return {{"label", input.matrix.labels[pair.label].id},
          {"transceiver",
           pair.transceiver ? Json(input.matrix.transceivers[*pair.transceiver].id) : Json(nullptr)},
          {"measured", pair.measured},
          {"expected", result.expected},
          {"residual_db", result.residual ? Json(*result.residual) : Json(nullptr)}};
}

}  // namespace

Json comparison_json(const ComparisonInput& input, std::size_t listed) {
  const Comparison& c = input.comparison;
  constexpr const char* shared[] = {"none", "of labels", "of transceivers", "of both"};
  Json outliers = Json::array(), worst = Json::array();
  for (const std::size_t k : c.outliers) outliers.push_back(pair_json(input, k));
  for (std::size_t k = 0; k < std::min(c.worst.size(), listed); ++k)
    worst.push_back(pair_json(input, c.worst[k]));
  const OneFactorTest test = c.test.value_or(OneFactorTest{});
  const auto if_known = [](const auto& known, auto value) { return known ? Json(value) : Json(); };
  return {{"pairs", input.pairs.size()},
          {"fitted", c.fitted},
          {"uncertain", c.uncertain},
          {"nothing_measured", c.measured_zero},
          {"factor", c.factor},
          {"confidence", c.confidence},
          {"factor_low", c.factor_interval.low},
          {"factor_high", c.factor_interval.high},
          {"shared_errors", shared[static_cast<std::size_t>(c.shared)]},
          {"spread_db", c.spread},
          {"median_residual_db", c.median_residual},
          {"ninety_residual_db", c.residual_quantile_90},
          {"correlation", c.correlation},
          {"slope", if_known(c.slope, c.slope.value_or(0))},
          {"slope_low", if_known(c.slope, c.slope_interval.low)},
          {"slope_high", if_known(c.slope, c.slope_interval.high)},
          {"chi_square", if_known(c.test, test.statistic)},
          {"degrees_of_freedom", if_known(c.test, test.degrees_of_freedom)},
          {"p_value", if_known(c.test, test.p_value)},
          {"one_factor", if_known(c.test, !test.rejected())},
          {"outliers", outliers},
          {"worst", worst}};
}

}  // namespace shelfbeam
