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
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

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

std::string optional_count(const Words& words, const std::optional<std::uint64_t>& count) {
  return count ? words.grouped(*count) : "–";
}

std::string price_text(const Words& words, double price, const std::string& currency) {
  const std::string amount = words.fixed(price, 2);
  return currency.empty() ? amount : fmt::format("{}\u00A0{}", amount, currency);
}

std::string duration_text(const Words& words, double seconds) {
  if (seconds < 600) return words.say("batch.seconds", words.fixed(seconds, 1));
  return seconds < 7200 ? words.say("batch.minutes", words.fixed(seconds / 60, 0))
                        : words.say("batch.hours", words.fixed(seconds / 3600, 1));
}

std::string memory_text(const Words& words, std::uint64_t bytes) {
  return words.say("batch.megabytes", words.grouped((bytes + 500'000) / 1'000'000));
}

// The lower bound on the minimised value.
std::string bound_text(const Words& words, const StoreResult& result) {
  return result.price_lower_bound
             ? price_text(words, rounded_down(*result.price_lower_bound, 2), result.currency)
             : optional_count(words, result.lower_bound);
}

// "north (8 to 11)": the bound and the value of planned stores that leave a gap, the first few of them.
std::string open_stores(const Words& words, Results results) {
  constexpr std::size_t shown = 5;
  std::vector<std::string> parts;
  std::size_t count = 0;
  for (const StoreResult& result : results) {
    if (!result.is_open() || ++count > shown) continue;
    const std::string value = result.price_lower_bound ? price_text(words, *result.price, result.currency)
                                                       : optional_count(words, result.units);
    parts.push_back(words.say("batch.range", result.name, bound_text(words, result), value));
  }
  if (count == 0) return {};
  const std::string list = fmt::format("{}", fmt::join(parts, ", "));
  return " " +
         words.say_count("batch.open", count, count > shown ? words.say("summary.and_others", list) : list);
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

std::vector<std::string> remarks(const Words& words, Results results) {
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
  std::string text = words.say_count("batch.units", units);
  for (const auto& [currency, price] : prices)
    text += " " + words.say("batch.price", price_text(words, price, currency));
  return {text, words.say("batch.scope"),
          words.say("batch.effort", duration_text(words, cpu_s), memory_text(words, peak))};
}

std::string need_section(const Words& words, Results results, std::string_view need) {
  HtmlTable table({{words.say("batch.column.store"), false},
                   {words.say("batch.column.units")},
                   {words.say("batch.column.bound")},
                   {words.say("batch.column.price")},
                   {words.say("batch.column.answer"), false, true},
                   {words.say("batch.column.cpu")},
                   {words.say("batch.column.memory")}});
  std::size_t count = 0;
  for (const StoreResult& result : results) {
    if (need_of(result) != need) continue;
    ++count;
    std::string answer = result.answer;
    if (!result.basis.empty()) answer += " " + result.basis;
    for (const Finding& warning : result.warnings)
      answer += " " + words.say("batch.warning", warning.sentence);
    const bool has_run = result.effort.runs > 0;
    table.add_row({result.name, optional_count(words, result.units), bound_text(words, result),
                   result.price ? price_text(words, *result.price, result.currency) : "–", answer,
                   has_run ? duration_text(words, result.effort.cpu_s) : "–",
                   has_run ? memory_text(words, result.effort.peak_memory) : "–"},
                  address(result.report));
  }
  if (count == 0) return {};
  return html_section(
      std::string(need),
      words.say("batch.title", words(fmt::format("batch.need.{}", need)), words.grouped(count)),
      paragraph(words.say(fmt::format("batch.todo.{}", need)), "note") + table.html());
}

}  // namespace

std::string batch_answer(const Words& words, Results results) {
  std::string text =
      words.say_count("batch.answer", results.size(), words.grouped(count_of(results, "planned")));
  std::string_view separator = words("batch.first_need");
  for (const std::string_view need : needs) {
    const std::size_t count = count_of(results, need);
    if (need == "planned" || count == 0) continue;
    text +=
        fmt::format("{}{} {}", separator, words.grouped(count), words(fmt::format("batch.short.{}", need)));
    separator = ", ";
  }
  return text + "." + open_stores(words, results);
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

std::string batch_html(const Words& words, Results results) {
  const std::string title = words.say("batch.page");
  const bool is_fine = count_of(results, "planned") == results.size();
  std::string body = html_header({is_fine ? "yes" : "open", escape(words("batch.kicker")), title,
                                  batch_answer(words, results), remarks(words, results)});
  for (const std::string_view need : needs) body += need_section(words, results, need);
  return html_page(words, title, "<main>\n" + body + "</main>\n");
}

}  // namespace shelfbeam
