#include <algorithm>
#include <span>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/io/placement_json.hpp"

namespace shelfbeam {

namespace {

using detail::backend_of;
using detail::first_ids;
using detail::format_version;
using detail::Json;
using detail::number;
using detail::Record;
using detail::TableIds;

void add_price(Json& file, const TableIds& ids, const Selection& selected) {
  if (has_prices(ids.table)) file["price"] = Record::write(price_of(ids.table, selected), ids);
}

}  // namespace

std::string coverage_json(const MaxCoverage& reach, const SignalTable& table) {
  const TableIds ids{table};
  Json file = {{"format", format_version},
               {"model", to_text(reach.problem.model)},
               {"survives_failure", reach.problem.redundant},
               {"at_most", reach.at_most},
               {"selected", ids.transceivers.list(reach.selected)},
               {"count", reach.selected.size()},
               {"labels", table.rows()},
               {"reached", reach.reached},
               {"reached_upper_bound", reach.upper_bound}};
  if (reach.weight) {
    file["reached_weight"] = reach.weight->reached;
    file["weight_upper_bound"] = reach.weight->upper_bound;
    file["total_weight"] = reach.weight->total;
  }
  file.update({{"gap", number(reach.gap())},
               {"bound_proof", to_text(reach.bound_proof)},
               {"status", to_text(reach.status)},
               {"too_large", reach.too_large},
               {"solver", to_text(reach.solver.method)},
               {"backend", backend_of(reach.solver)},
               {"missed", first_ids(reach.missed, ids.labels)}});
  add_price(file, ids, reach.selected);
  return detail::file_text(file);
}

std::string fewest_units_json(const FewestUnits& fewest, const SignalTable& table) {
  const TableIds ids{table};
  const bool found = fewest.has_selection, is_possible = fewest.status != Status::infeasible;
  Json file = {{"format", format_version},
               {"model", to_text(fewest.problem.model)},
               {"survives_failure", fewest.problem.redundant},
               {"reach", fewest.share},
               {"target", fewest.target},
               {"selected", ids.transceivers.list(fewest.selected)},
               {"count", found ? Json(fewest.selected.size()) : Json(nullptr)},
               {"count_lower_bound", is_possible ? Json(fewest.count_lower_bound) : Json(nullptr)},
               {"labels", table.rows()},
               {"reached", found ? Json(fewest.reached) : Json(nullptr)}};
  if (has_weights(table)) {
    file["reached_weight"] = found ? Json(fewest.weight.reached) : Json(nullptr);
    file["total_weight"] = fewest.weight.total;
  }
  file["reachable"] = fewest.weight.upper_bound;
  file.update({{"bound_proof", to_text(fewest.bound_proof)},
               {"status", to_text(fewest.status)},
               {"too_large", fewest.too_large},
               {"solver", to_text(fewest.solver.method)},
               {"backend", backend_of(fewest.solver)},
               {"missed", first_ids(fewest.missed, ids.labels)}});
  if (found) add_price(file, ids, fewest.selected);
  return detail::file_text(file);
}

}  // namespace shelfbeam
