#include "shelfbeam/report/batch/batch_report.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

using Results = std::span<const StoreResult>;

// The reasons why a result needs attention, most urgent first; "planned" needs none.
constexpr std::array<std::string_view, 6> needs{"failed",    "unfinished", "infeasible",
                                                "undecided", "warnings",   "planned"};

std::string_view need_of(const StoreResult& result) {
  if (result.status == StoreStatus::planned && !result.warnings.empty()) return "warnings";
  return to_text(result.status);
}

std::size_t count_of(Results results, std::string_view need) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const StoreResult& result) { return need_of(result) == need; }));
}

std::string optional_count(const std::optional<std::uint64_t>& count) {
  return count ? grouped(*count) : "–";
}

std::string price_text(double price, const std::string& currency) {
  const std::string amount = fixed(price, 2);
  return currency.empty() ? amount : fmt::format("{}\u00A0{}", amount, currency);
}

std::string duration_text(double seconds) {
  if (seconds < 600) return say("batch.seconds", fixed(seconds, 1));
  return seconds < 7200 ? say("batch.minutes", fixed(seconds / 60, 0))
                        : say("batch.hours", fixed(seconds / 3600, 1));
}

std::string memory_text(std::uint64_t bytes) {
  return say("batch.megabytes", grouped((bytes + 500'000) / 1'000'000));
}

// The lower bound on the minimised value.
std::string bound_text(const StoreResult& result) {
  return result.price_lower_bound ? price_text(rounded_down(*result.price_lower_bound, 2), result.currency)
                                  : optional_count(result.lower_bound);
}

// "north (8 to 11)": the bound and the value of planned stores that leave a gap, the first few of them.
std::string open_stores(Results results) {
  constexpr std::size_t shown = 5;
  std::vector<std::string> parts;
  std::size_t count = 0;
  for (const StoreResult& result : results) {
    if (!result.is_open() || ++count > shown) continue;
    const std::string value =
        result.price_lower_bound ? price_text(*result.price, result.currency) : optional_count(result.units);
    parts.push_back(say("batch.range", result.name, bound_text(result), value));
  }
  if (count == 0) return {};
  const std::string list = fmt::format("{}", fmt::join(parts, ", "));
  return " " + say_count("batch.open", count, count > shown ? say("summary.and_others", list) : list);
}

// A path as an address relative to the page.
std::string address(std::string_view path) {
  constexpr std::string_view kept = "/-._~";
  std::string text;
  for (const char c : path)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || kept.find(c) != std::string_view::npos)
      text += c;
    else
      text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return text;
}

std::vector<std::string> remarks(Results results) {
  double cpu_s = 0;
  std::uint64_t peak = 0;
  std::map<std::string, double> prices;
  std::uint64_t units = 0;
  for (const StoreResult& result : results) {
    cpu_s += result.effort.cpu_s;
    peak = std::max(peak, result.effort.peak_memory);
    if (result.price) prices[result.currency] += *result.price;
    units += result.units.value_or(0);
  }
  std::string text = say_count("batch.units", units);
  for (const auto& [currency, price] : prices) text += " " + say("batch.price", price_text(price, currency));
  return {text, say("batch.scope"), say("batch.effort", duration_text(cpu_s), memory_text(peak))};
}

std::string need_section(Results results, std::string_view need) {
  HtmlTable table({{say("batch.column.store"), false},
                   {say("batch.column.units")},
                   {say("batch.column.bound")},
                   {say("batch.column.price")},
                   {say("batch.column.answer"), false, true},
                   {say("batch.column.cpu")},
                   {say("batch.column.memory")}});
  std::size_t count = 0;
  for (const StoreResult& result : results) {
    if (need_of(result) != need) continue;
    ++count;
    std::string answer = result.answer;
    for (const Finding& warning : result.warnings) answer += " " + say("batch.warning", warning.sentence);
    const bool has_run = result.effort.runs > 0;
    table.add_row({result.name, optional_count(result.units), bound_text(result),
                   result.price ? price_text(*result.price, result.currency) : "–", answer,
                   has_run ? duration_text(result.effort.cpu_s) : "–",
                   has_run ? memory_text(result.effort.peak_memory) : "–"},
                  address(result.report));
  }
  if (count == 0) return {};
  return html_section(std::string(need),
                      say("batch.title", words(fmt::format("batch.need.{}", need)), grouped(count)),
                      paragraph(say(fmt::format("batch.todo.{}", need)), "note") + table.html());
}

}  // namespace

std::string batch_answer(Results results) {
  std::string text = say_count("batch.answer", results.size(), grouped(count_of(results, "planned")));
  std::string_view separator = words("batch.first_need");
  for (const std::string_view need : needs) {
    const std::size_t count = count_of(results, need);
    if (need == "planned" || count == 0) continue;
    text += fmt::format("{}{} {}", separator, grouped(count), words(fmt::format("batch.short.{}", need)));
    separator = ", ";
  }
  return text + "." + open_stores(results);
}

std::string batch_csv(Results results, bool safe) {
  const auto text = [&](std::string_view field) { return csv_field(field, safe); };
  const auto number = [](const auto& value) { return value ? csv_number(static_cast<double>(*value)) : ""; };
  std::string csv =
      "name,store,status,units,lower_bound,price,price_lower_bound,currency,labels,warnings,answer,report,"
      "runs,cpu_s,wall_s,"
      "peak_memory\n";
  for (const StoreResult& result : results) {
    const PlanEffort& effort = result.effort;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{:.3f},{:.3f},{}\n", text(result.name),
                       text(result.store), to_text(result.status), number(result.units),
                       number(result.lower_bound), number(result.price), number(result.price_lower_bound),
                       text(result.currency), result.labels, result.warnings.size(), text(result.answer),
                       text(result.report), effort.runs, effort.cpu_s, effort.wall_s, effort.peak_memory);
  }
  return csv;
}

std::string batch_html(Results results) {
  const std::string title = say("batch.page");
  const bool is_fine = count_of(results, "planned") == results.size();
  std::string body = html_header({is_fine ? "yes" : "open", escape(words("batch.kicker")), title,
                                  batch_answer(results), remarks(results)});
  for (const std::string_view need : needs) body += need_section(results, need);
  return html_page(title, "<main>\n" + body + "</main>\n");
}

}  // namespace shelfbeam
