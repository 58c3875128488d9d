#include "shelfbeam/plan/io/alternatives_json.hpp"

#include "shelfbeam/placement/io/placement_json.hpp"

namespace shelfbeam::detail {

void describe(Record& record, Alternative& one) {
  const auto labels = static_cast<std::int64_t>(record.ids().labels.size());
  record.note("count", [&] { return one.selected.size(); });
  record.id_list("selected", one.selected, record.ids().transceivers);
  record.nullable("price", one.price);
  record.count("reached", one.reached, labels);
  record.count("reached_upper_bound", one.max_reached, labels);
  record.number("smallest_margin", one.smallest_margin);
  record.count("secure", one.secure, labels);
  record.boolean("proven", one.is_proven);
  if (record.file() == nullptr) return;
  if (const JsonCursor count = (*record.file())["count"];
      count.number() != static_cast<double>(one.selected.size()))
    count.fail("is not the number of selected transceivers", "correct one of them");
}

void describe(Record& record, Alternatives& alternatives) {
  record.optional("one_fewer", alternatives.one_fewer);
  record.optional("one_more", alternatives.one_more);
  record.optional("survives_failure", alternatives.survives_failure);
  record.boolean("cannot_survive", alternatives.cannot_survive);
}

}  // namespace shelfbeam::detail
