#include "shelfbeam/base/csv.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/place/place_text.hpp"

namespace shelfbeam {

namespace {

std::string coordinates(const Vec3& v) {
  return csv_number(v.x) + "," + csv_number(v.y) + "," + csv_number(v.z);
}

std::string row(std::initializer_list<std::string> fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

// The last columns of a label: its article and its place.
std::string of_the_shop(const Label* label, const auto& text) {
  if (label == nullptr) return ",,,\n";
  const LabelPlace& place = label->place;
  return row({text(label->description), text(place.fixture),
              place.face ? std::string(to_text(*place.face)) : "",
              place.board > 0 ? fmt::format("{}", place.board) : ""});
}

}  // namespace

std::string labels_csv(const ReportInput& input) {
  const SignalMatrix& matrix = input.matrix;
  const Outcome outcome = outcome_of(matrix, input.plan.placement, input.plan.certificate);
  const auto text = [&](std::string_view field) { return csv_field(field, input.safe_csv); };
  const bool has_direct = matrix.direct.size() == matrix.mean.size();
  const auto& availability = input.plan.availability;
  const bool has_states = availability && availability->has_answer();
  std::unordered_map<std::string_view, const Label*> labels;
  for (const Label& label : input.scene.labels) labels.emplace(label.id, &label);
  std::string csv = fmt::format(
      "id,x,y,z,nx,ny,nz,type,requirement,signal,margin_db,direct_share,serving,strongest,error_trusted{}"
      ",description,fixture,face,board\n",
      has_states ? ",availability" : "");
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const LabelRow& label = matrix.labels[i];
    const LabelOutcome& result = outcome.labels[i];
    std::string serving;
    for (const std::uint32_t column : result.reached_by)
      serving += (serving.empty() ? "" : ";") + matrix.transceivers[column].id;
    const bool is_known = !matrix.flags.empty() && !input.plan.placement.selected.empty();
    csv += row({text(label.id), coordinates(label.position), coordinates(label.normal), text(label.type),
                csv_number(label.requirement), csv_number(result.signal), csv_number(result.margin()),
                has_direct && result.signal > 0 ? csv_number(result.direct / result.signal) : "",
                text(serving), result.strongest ? text(matrix.transceivers[*result.strongest].id) : "",
                !is_known                   ? ""
                : result.depends_on_flagged ? "no"
                                            : "yes"});
    const auto found = labels.find(label.id);
    csv.pop_back();
    if (has_states) csv += "," + csv_number(availability->answer().availability(i));
    csv += "," + of_the_shop(found == labels.end() ? nullptr : found->second, text);
  }
  return csv;
}

std::string placement_csv(const ReportInput& input) {
  const SignalMatrix& matrix = input.matrix;
  const Outcome outcome = outcome_of(matrix, input.plan.placement);
  const auto text = [&](std::string_view field) { return csv_field(field, input.safe_csv); };
  std::map<std::string_view, double> roll_deg;
  for (const Transceiver& transceiver : input.scene.transceivers)
    roll_deg.emplace(transceiver.id, transceiver.roll_deg);
  const Words words = words_of(input.scene);
  const ShopPlaces places(input.scene);
  std::string csv =
      "id,x,y,z,ax,ay,az,roll_deg,type,cost,installed,reaches_alone,strongest_for,needed_by,pinned,place,"
      "order_number\n";
  for (const UnitOutcome& unit : outcome.units) {
    const TransceiverColumn& t = matrix.transceivers[unit.column];
    const auto roll = roll_deg.find(t.id);
    const TransceiverType* const type = unit_type(input.scene, t.type);
    csv += row({text(t.id), coordinates(t.position), coordinates(t.axis),
                csv_number(roll == roll_deg.end() ? 0 : roll->second), text(t.type), csv_number(t.cost),
                t.installed ? "1" : "0", fmt::format("{}", unit.reaches_alone),
                fmt::format("{}", unit.strongest_for), fmt::format("{}", unit.needed_by),
                t.pinned ? "1" : "0", text(place_text(words, places.of(t.position))),
                type == nullptr ? std::string() : text(type->order_number)});
  }
  return csv;
}

}  // namespace shelfbeam
