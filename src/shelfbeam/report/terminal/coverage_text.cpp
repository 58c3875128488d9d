#include "shelfbeam/report/terminal/coverage_text.hpp"

#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

/// In percent; 100 without labels.
double percentage(double part, double whole) {
  return whole <= 0 ? 100 : 100 * part / whole;
}

double percentage(std::size_t labels, const SignalTable& table) {
  return percentage(static_cast<double>(labels), static_cast<double>(table.rows()));
}

/// Shares in percent that claim no more than is proven: "62.3".
std::string proven_most(double part, double whole) {
  return fmt::format("{:.1f}", rounded_up(percentage(part, whole), 1));
}
std::string proven_least(double part, double whole) {
  return fmt::format("{:.1f}", rounded_down(percentage(part, whole), 1));
}

/// "199 of 390 labels, 51.0 %" or "199 of 390 labels, 62.3 % of the weight"; no share for all labels.
std::string reached_part(std::size_t reached, const std::optional<CoverageWeight>& weight,
                         const SignalTable& table) {
  std::string text = labels_reached(english(), reached, table.rows());
  if (reached == table.rows()) return text;
  return text + (weight ? fmt::format(", {:.1f} % of the weight", percentage(weight->reached, weight->total))
                        : fmt::format(", {:.1f} %", percentage(reached, table)));
}

/// The price of a choice that no price has decided.
std::string price_line(const Selection& selected, const SignalTable& table) {
  if (!has_prices(table)) return {};
  const Price price = price_of(table, selected);
  return fmt::format("  price: {} of new units, {} in total; prices are not considered in this choice\n",
                     money(english(), price.to_spend, price), money(english(), price.total, price));
}

std::string size_line(bool is_too_large, Status status) {
  const bool matters = is_too_large && status != Status::optimal && status != Status::infeasible;
  return matters ? "  the matrix is too large for the exact method\n" : "";
}

std::string better_bound(const MaxCoverage& reach, const SignalTable& table) {
  std::string text = "; it is proven that no ";
  text += reach.at_most == 1 ? "single transceiver reaches more"
                             : fmt::format("{} reach more", counted(reach.at_most, "transceiver"));
  if (reach.status == Status::optimal) return text;
  return text + (reach.weight
                     ? fmt::format(" than {} %", proven_most(reach.weight->upper_bound, reach.weight->total))
                     : fmt::format(" than {}, {:.1f} %", english().grouped(reach.upper_bound),
                                   percentage(reach.upper_bound, table)));
}

/// "95 % of the 390 labels", "95 % of the weight of the 390 labels"
std::string required_part(const FewestUnits& fewest, const SignalTable& table) {
  return fmt::format("{:.6g} % of the {}{}", 100 * fewest.share, has_weights(table) ? "weight of the " : "",
                     counted(table.rows(), "label"));
}

/// The share that no selection exceeds, with as many digits as separate it from the required share.
std::string most_below_share(const FewestUnits& fewest) {
  const double most = percentage(fewest.weight.upper_bound, fewest.weight.total);
  int decimals = 1;
  while (decimals < 6 && rounded_up(most, decimals) >= 100 * fewest.share) ++decimals;
  return fmt::format("{:.{}f}", rounded_up(most, decimals), decimals);
}

/// The sentences about counts are those of a placement.
Placement as_placement(const FewestUnits& fewest) {
  Placement placement;
  placement.problem = fewest.problem;
  placement.selected = fewest.selected;
  placement.count_lower_bound = static_cast<double>(fewest.count_lower_bound);
  return placement;
}

std::string answer(const FewestUnits& fewest, const SignalTable& table) {
  const std::string required = required_part(fewest, table);
  if (fewest.status == Status::infeasible)
    return fmt::format("No selection reaches {} ({}); it is proven that none reaches more than {} %.\n",
                       required, model_of(fewest.problem), most_below_share(fewest));
  if (!fewest.has_selection)
    return fmt::format("No selection that reaches {} was found; {}.\n", required,
                       units_needed(english(), fewest.count_lower_bound));
  std::optional<CoverageWeight> weight;
  if (has_weights(table)) weight = fewest.weight;
  return fmt::format("{} {} ({}); {:.6g} % are required, and {}.\n",
                     units_reach(english(), fewest.selected.size()),
                     reached_part(fewest.reached, weight, table), model_of(fewest.problem),
                     100 * fewest.share, terminal_bound(english(), as_placement(fewest)));
}

}  // namespace

std::string describe(const MaxCoverage& reach, const SignalTable& table) {
  std::string text = fmt::format("{} {} ({})", units_reach(english(), reach.selected.size()),
                                 reached_part(reach.reached, reach.weight, table), model_of(reach.problem));
  if (reach.reached != table.rows()) text += better_bound(reach, table);
  text += ".\n" + chosen(reach.selected, table) + price_line(reach.selected, table);
  const std::string range =
      reach.weight ? fmt::format("reached weight {:.9g} of {:.9g}, upper bound {:.9g}", reach.weight->reached,
                                 reach.weight->total, reach.weight->upper_bound)
                   : fmt::format("reached {}, upper bound {}", reach.reached, reach.upper_bound);
  text += fmt::format("  {}: {}, gap {:.1f} %; {:.2f} s, solver {}\n", to_text(reach.status), range,
                      100 * reach.gap(), reach.seconds, solver_text(english(), reach.solver));
  return text + fmt::format("  bound: {}\n", bound_proof_text(english(), reach.bound_proof)) +
         size_line(reach.too_large, reach.status);
}

std::string describe(const FewestUnits& fewest, const SignalTable& table) {
  std::string text = answer(fewest, table);
  if (fewest.has_selection) text += chosen(fewest.selected, table) + price_line(fewest.selected, table);
  text += fmt::format("  {}", to_text(fewest.status));
  if (fewest.has_selection)
    text += fmt::format(": count {}, lower bound {}", fewest.selected.size(), fewest.count_lower_bound);
  text += fmt::format("; {:.2f} s, solver {}\n", fewest.seconds, solver_text(english(), fewest.solver));
  return text + fmt::format("  bound: {}\n", bound_proof_text(english(), fewest.bound_proof)) +
         size_line(fewest.too_large, fewest.status);
}

std::string describe(const CoverageCurve& curve, const SignalTable& table) {
  if (curve.points.empty() || table.rows() == 0) return {};
  const bool weighs = curve.points.front().weight.has_value();
  std::string text = weighs ? "  units   weight reached: at least   at most\n"
                            : "  units   labels reached: at least   at most\n";
  const double total = weighs ? curve.points.back().weight->at_most : static_cast<double>(table.rows());
  for (const CurvePoint& point : curve.points) {
    const double at_least = weighs ? point.weight->at_least : static_cast<double>(point.at_least);
    const double at_most = weighs ? point.weight->at_most : static_cast<double>(point.at_most);
    text += fmt::format("  {:5}                  {:>7} % {:>7} %\n", point.units,
                        proven_least(at_least, total), proven_most(at_most, total));
  }
  if (!curve.is_complete) text += "  the curve was stopped early; more time may narrow its bounds\n";
  return text;
}

}  // namespace shelfbeam
