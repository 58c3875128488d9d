#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/report/data/bill.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/messages/summary.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string list(const Words& words, const char* key, const std::vector<std::string>& items) {
  if (items.empty()) return {};
  return fmt::format("<div>\n<h2>{}</h2>\n{}</div>\n", escape(words(key)), html_list(items));
}

// The number of units and the price of every type.
std::string shopping_list(const ReportData& data) {
  const Bill bill = bill_of(data.input);
  const std::optional<Price>& price = data.input.plan.placement.price;
  const auto any = [&](const auto& has) { return std::any_of(bill.lines.begin(), bill.lines.end(), has); };
  const bool has_there = any([](const BillLine& line) { return line.installed > 0; });
  const bool has_orders = any([](const BillLine& line) { return !line.order_number.empty(); });
  std::vector<HtmlTable::Column> columns{{data.words.say("summary.buy.type"), false}};
  if (has_orders) columns.push_back({data.words.say("summary.buy.order"), false});
  columns.push_back({data.words.say("summary.buy.new")});
  if (has_there) columns.push_back({data.words.say("summary.buy.there")});
  if (bill.has_prices) {
    columns.push_back({data.words.say("summary.buy.each")});
    columns.push_back({data.words.say("summary.buy.price")});
  }
  HtmlTable table(columns);
  const auto add = [&](const BillLine& line, const std::string& each, double amount) {
    const TransceiverType* type = unit_type(data.input.scene, line.type);
    const bool is_product = type != nullptr && !type->origin.name.empty();
    std::vector<std::string> cells{is_product ? type->origin.name : line.type};
    if (has_orders) cells.push_back(line.order_number);
    cells.push_back(line.pinned > 0 ? data.words.say("summary.buy.pinned", data.words.grouped(line.fresh),
                                                     data.words.grouped(line.pinned))
                                    : data.words.grouped(line.fresh));
    if (has_there) cells.push_back(data.words.grouped(line.installed));
    if (bill.has_prices) cells.insert(cells.end(), {each, money(data.words, amount, price)});
    table.add_row(cells);
  };
  BillLine all{.type = data.words.say("summary.buy.total")};
  for (const BillLine& line : bill.lines) {
    add(line, money(data.words, line.price, price), line.amount());
    all.fresh += line.fresh;
    all.pinned += line.pinned;
    all.installed += line.installed;
  }
  if (bill.lines.size() > 1) add(all, "", bill.amount);
  return fmt::format("<div>\n<h2>{}</h2>\n{}</div>\n", escape(data.words("summary.buy.title")), table.html());
}

std::string times(const Words& words, double ratio) {
  return std::isfinite(ratio) ? words.say("summary.alternatives.times", words.significant(ratio)) : "–";
}

std::string alternatives_table(const ReportData& data) {
  const CertifiedPlan& plan = data.input.plan;
  const Alternatives& others = plan.alternatives;
  if (others.empty()) return {};
  const bool has_prices = plan.placement.price.has_value();
  const bool by_price = plan.placement.problem.combination == Combination::spend;
  std::vector<HtmlTable::Column> columns{{data.words.say("summary.alternatives.choice"), false, true},
                                         {data.words.say("summary.alternatives.units")}};
  if (has_prices) columns.push_back({data.words.say("summary.alternatives.new_price")});
  const bool has_reserve = plan.has_known_thresholds();
  columns.push_back({data.words.say("summary.alternatives.reached")});
  if (has_reserve) columns.push_back({data.words.say("summary.alternatives.weakest")});
  columns.push_back({data.words.say("summary.alternatives.secure")});
  HtmlTable table(columns, HtmlTable::Narrow::cards);
  const auto price_of = [&](const Alternative& one) {
    return one.price ? money(data.words, one.price->to_spend, one.price) : "–";
  };
  const auto add = [&](const std::string& name, const Alternative& one, const std::string& units,
                       const std::string& price, const std::string& reached) {
    std::vector<std::string> cells{name, units};
    if (has_prices) cells.push_back(price);
    cells.push_back(reached);
    if (has_reserve) cells.push_back(times(data.words, one.smallest_margin));
    cells.push_back(data.words.grouped(one.secure));
    table.add_row(cells);
  };
  const auto units = [&](const Alternative& one) { return data.words.grouped(one.selected.size()); };
  Alternative own;
  own.selected = plan.placement.selected;
  own.price = plan.placement.price;
  own.secure = data.outcome.secure;
  own.smallest_margin = data.outcome.labels[data.outcome.by_margin.front()].ratio();
  add(data.words.say("summary.alternatives.this"), own, units(own), price_of(own),
      data.words.grouped(data.outcome.met));
  if (const auto& one = others.one_fewer)
    add(data.words.say(one->selected.size() + 1 < own.selected.size() ? "summary.alternatives.fewer"
                                                                      : "summary.alternatives.one_fewer"),
        *one, units(*one), price_of(*one),
        one->is_proven ? data.words.grouped(one->reached)
                       : data.words.say("summary.alternatives.at_most", data.words.grouped(one->reached),
                                        data.words.grouped(one->max_reached)));
  if (const auto& one = others.one_more)
    add(data.words.say("summary.alternatives.more"), *one, units(*one), price_of(*one),
        data.words.grouped(one->reached));
  if (const auto& one = others.survives_failure) {
    std::string count = units(*one), price = price_of(*one);
    // A better choice would have fewer units, or cost less.
    if (!one->is_proven && by_price)
      price = data.words.say("summary.alternatives.not_proven_price", price);
    else if (!one->is_proven)
      count = data.words.say("summary.alternatives.not_proven", count);
    add(data.words.say("summary.alternatives.survive"), *one, count, price, data.words.grouped(one->reached));
  }
  std::string html = table.html();
  if (others.cannot_survive)
    html += paragraph(fmt::format("{}: {}.", data.words("summary.alternatives.survive"),
                                  data.words("summary.alternatives.cannot")),
                      "note");
  return fmt::format("<h2>{}</h2>\n{}{}", escape(data.words("summary.alternatives.title")), html,
                     paragraph(data.words.say(has_reserve ? "summary.alternatives.note"
                                                          : "summary.alternatives.note_without_reserve"),
                               "note"));
}

// What each change requires, between the plan for the shop as in the store file and this one.
std::string reasons_table(const ReportData& data) {
  const auto& availability = data.input.plan.availability;
  if (!availability || availability->alone.empty()) return {};
  HtmlTable table({{data.words.say("reasons.column.change"), false, true},
                   {data.words.say("reasons.column.taken")},
                   {data.words.say("reasons.column.units")}});
  for (const ReasonRow& row : reason_rows(data.words, *availability, data.input.plan.placement))
    table.add_row({row.change, row.taken, row.units});
  return fmt::format("<h2>{}</h2>\n{}{}", escape(data.words("reasons.title")), table.html(),
                     paragraph(reasons_note(data.words, *availability), "note"));
}

}  // namespace

std::string summary_section(const ReportData& data, const Maps& maps) {
  const Summary summary = summary_of(data);
  const std::string& name = data.input.scene.name;
  std::string html =
      html_header({key_of(summary.tone),
                   fmt::format("{} <span class=\"verdict\">{}</span>", escape(data.words("summary.kicker")),
                               escape(summary.verdict)),
                   name.empty() ? data.words.say("summary.store") : name, summary.answer, summary.remarks});
  if (!summary.assumed.empty()) html += paragraph(summary.assumed, "assumed");
  if (const std::string advice = recommendation(data); !advice.empty())
    html += paragraph(advice, "recommended");
  if (data.has_selection())
    html += "<div class=\"pair\">\n" + shopping_list(data) +
            list(data.words,
                 data.input.plan.has_known_thresholds() ? "summary.achieves.title"
                                                        : "summary.achieves.title_without_reserve",
                 summary.achieves) +
            "</div>\n" + list(data.words, "summary.risks.title", summary.risks) + alternatives_table(data);
  html += reasons_table(data);
  html += maps.overview(data.words.say(data.has_selection() ? "summary.drawing" : "summary.drawing_none"));
  return "<div class=\"first-page\">\n" + html + "</div>\n";
}

std::string warning_section(const ReportData& data) {
  const std::vector<std::string> warnings = sentences(data.input.plan.warnings);
  if (warnings.empty()) return {};
  return html_section("warnings", data.words.say("warnings.title"),
                      paragraph(data.words.say("warnings.intro")) + html_list(warnings));
}

}  // namespace shelfbeam
