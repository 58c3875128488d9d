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

// `own`: the keys that only this kind of answer has, or has in other words.
std::string answer_json(const PartialAnswer& answer, const TableIds& ids, const Json& own, bool found) {
  Json file = {{"format", format_version},
               {"model", to_text(answer.problem.model)},
               {"survives_failure", answer.problem.redundant}};
  file.update(own);
  file.update({{"bound_proof", to_text(answer.bound_proof)},
               {"status", to_text(answer.status)},
               {"too_large", answer.too_large},
               {"solver", to_text(answer.solver.method)},
               {"backend", backend_of(answer.solver)},
               {"missed", first_ids(answer.missed, ids.labels)}});
  if (found && has_prices(ids.table))
    file["price"] = Record::write(price_of(ids.table, answer.selected), ids);
  return detail::file_text(file);
}

}  // namespace

std::string coverage_json(const MaxCoverage& reach, const SignalTable& table) {
  const TableIds ids{table};
  Json own = {{"at_most", reach.at_most},       {"selected", ids.transceivers.list(reach.selected)},
              {"count", reach.selected.size()}, {"labels", table.rows()},
              {"reached", reach.reached},       {"reached_upper_bound", reach.upper_bound}};
  if (reach.weight) {
    own["reached_weight"] = reach.weight->reached;
    own["weight_upper_bound"] = reach.weight->upper_bound;
    own["total_weight"] = reach.weight->total;
  }
  own["gap"] = number(reach.gap());
  return answer_json(reach, ids, own, true);
}

std::string fewest_units_json(const FewestUnits& fewest, const SignalTable& table) {
  const TableIds ids{table};
  const bool found = fewest.has_selection, is_possible = fewest.status != Status::infeasible;
  Json own = {{"reach", fewest.share},
              {"target", fewest.target},
              {"selected", ids.transceivers.list(fewest.selected)},
              {"count", found ? Json(fewest.selected.size()) : Json(nullptr)},
              {"count_lower_bound", is_possible ? Json(fewest.count_lower_bound) : Json(nullptr)},
              {"labels", table.rows()},
              {"reached", found ? Json(fewest.reached) : Json(nullptr)}};
  if (has_weights(table)) {
    own["reached_weight"] = found ? Json(fewest.weight.reached) : Json(nullptr);
    own["total_weight"] = fewest.weight.total;
  }
  own["reachable"] = fewest.weight.upper_bound;
  return answer_json(fewest, ids, own, found);
}

}  // namespace shelfbeam
