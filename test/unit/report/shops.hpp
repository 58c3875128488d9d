#pragma once

#include <cctype>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/sample_store.hpp"

namespace shelfbeam::test {

using namespace sample_store;

// A strict reader for the markup of reports: XML rules, plus HTML's void elements.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;

  /// The value of an attribute; empty without it.
  std::string operator[](const std::string& attribute) const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? "" : found->second;
  }
};

struct Markup {
  std::string problem;  ///< empty: well-formed
  std::vector<Element> elements;
  std::string text;  ///< all text between tags, without style sheets, with entities resolved

  std::vector<Element> of_class(std::string_view css_class) const {
    std::vector<Element> found;
    for (const Element& element : elements)
      if (element["class"] == css_class) found.push_back(element);
    return found;
  }
};

inline std::string resolve_entities(std::string_view text, std::string& problem) {
  static const std::map<std::string, std::string, std::less<>> entities{
      {"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}};
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '&') {
      out += text[at++];
      continue;
    }
    const std::size_t end = text.find(';', at);
    const auto known = entities.find(text.substr(at, end == text.npos ? 1 : end - at + 1));
    if (known == entities.end()) {
      problem = "bare ampersand: " + std::string(text.substr(at, 20));
      return out;
    }
    out += known->second;
    at = end + 1;
  }
  return out;
}

/// The page without its scripts, as a reader without JavaScript sees it.
inline std::string without_scripts(std::string_view html) {
  std::string result;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t tag = html.find("<script", at), begin = html.find('>', tag);
    if (begin == html.npos) return result += html.substr(at);
    result += html.substr(at, begin + 1 - at);
    at = std::min(html.find("</script>", begin), html.size());
  }
  return result;
}

inline Markup read_markup(std::string_view html) {
  static const std::set<std::string, std::less<>> endless{"meta", "br", "hr", "img", "link", "input"};
  Markup result;
  std::vector<std::string> open;
  std::size_t at = 0;
  const auto fail = [&](const std::string& what) {
    result.problem = what + " at: " + std::string(html.substr(std::min(at, html.size()), 60));
    return result;
  };
  while (at < html.size()) {
    const std::size_t tag = html.find('<', at);
    const std::string_view between = html.substr(at, tag == html.npos ? html.npos : tag - at);
    if (between.find('>') != between.npos && (open.empty() || open.back() != "style")) return fail("bare >");
    if (open.empty() || open.back() != "style")
      result.text += resolve_entities(between, result.problem) + "\n";
    if (!result.problem.empty() || tag == html.npos) break;
    at = tag + 1;
    if (html[at] == '!' || html[at] == '?') {
      at = html.find('>', at) + 1;
      continue;
    }
    const bool closing = html[at] == '/';
    if (closing) ++at;
    Element element;
    while (at < html.size() && (std::isalnum(static_cast<unsigned char>(html[at])) != 0))
      element.name += html[at++];
    if (element.name.empty()) return fail("bare <");
    if (closing) {
      if (open.empty() || open.back() != element.name || html[at] != '>') return fail("unexpected end tag");
      open.pop_back();
      ++at;
      continue;
    }
    while (at < html.size() && html[at] == ' ') {
      while (html[at] == ' ') ++at;
      const std::size_t equals = html.find('=', at), quote = equals + 1;
      if (equals == html.npos || html[quote] != '"') return fail("attribute without a quoted value");
      const std::size_t end = html.find('"', quote + 1);
      const std::string name(html.substr(at, equals - at));
      const std::string_view value = html.substr(quote + 1, end - quote - 1);
      if (end == html.npos || value.find('<') != value.npos) return fail("broken attribute");
      if (!element.attributes.emplace(name, resolve_entities(value, result.problem)).second)
        return fail("attribute given twice");
      at = end + 1;
    }
    const bool self_closed = html.substr(at, 2) == "/>";
    if (!self_closed && (at >= html.size() || html[at] != '>')) return fail("tag is not closed");
    at += self_closed ? 2 : 1;
    if (!self_closed && !endless.contains(element.name)) open.push_back(element.name);
    result.elements.push_back(std::move(element));
  }
  if (result.problem.empty() && !open.empty()) result.problem = "never closed: " + open.back();
  return result;
}

inline std::size_t count_of(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; ++at) ++count;
  return count;
}

/// A shop with signals, a plan, and the input of its report.
struct PlannedShop {
  explicit PlannedShop(Store of) : store(std::move(of)) {}
  PlannedShop(const PlannedShop& other)
      : store(other.store), scene(other.scene), matrix(other.matrix), plan(other.plan) {}

  Store store;
  Scene scene = make_scene(store);
  SignalMatrix matrix = matrix_of(scene);
  CertifiedPlan plan{cover(matrix)};
  Placement& placement = plan.placement;
  ReportInput input{scene, matrix, plan};
};

/// A matrix with entries in [0, 1), a third of them zero, direct light below the mean, and requirements
/// around 1.
inline SignalMatrix random_matrix(std::uint32_t rows, std::uint32_t columns, std::uint32_t trial) {
  const auto draw = [trial](std::uint32_t i, std::uint32_t j, std::size_t k) {
    return to_uniform(philox({i, j, trial, 0}, 11)[k]);
  };
  SignalMatrix matrix;
  for (std::uint32_t i = 0; i < rows; ++i)
    matrix.labels.push_back({"L" + std::to_string(i),
                             "standard",
                             {0.3 * i, 1, 0.4 + 0.4 * (i % 3)},
                             {0, -1, 0},
                             0.5 + draw(i, 1000, 0),
                             0,
                             0,
                             8 + i % 2,
                             1000 + 10 * i});
  for (std::uint32_t j = 0; j < columns; ++j)
    matrix.transceivers.push_back(
        {"T" + std::to_string(j), "ceiling", {0.5 * j, 2, 3}, {0, 0, -1}, 1, j == 1});
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double mean = draw(i, j, 0) < 1.0 / 3 ? 0 : draw(i, j, 1);
      matrix.mean.push_back(static_cast<float>(mean));
      matrix.direct.push_back(static_cast<float>(mean * draw(i, j, 2)));
      matrix.standard_error.push_back(static_cast<float>(0.1 * mean * draw(i, j, 3)));
    }
  return matrix;
}

/// A shop with a slanted wall from (8, 0) to (12, 4), a shaft and a bakery with a lower ceiling. The inner
/// wall W1 has a door and a window with a pane; W2 is joined to it, ends at the slanted wall and is 1 m high.
inline Store corner_shop() {
  Store store = empty_store("Corner shop", {12, 10, 3.2});
  Room& room = *store.room;
  room.shape.is_box = false;
  room.shape.outline = {{0, 0}, {8, 0}, {12, 4}, {12, 10}, {0, 10}};
  room.shape.holes = {{{8, 6}, {9, 6}, {9, 7}, {8, 7}}};
  room.shape.zones = {{"bakery", {{0, 6}, {4, 6}, {4, 10}, {0, 10}}, {2.6, {}}}};
  room.shape.inner_walls = {
      {"W1", {6, 0}, {6, 3}, 0.2, {}, {{0.5, 0.9, 0, 2.1, false}, {1.8, 0.8, 0.9, 2, true}}},
      {"W2", {6, 3}, {11, 3}, 0.2, 1.0, {}}};
  store.materials.push_back({"glass", ThinDielectric{}});
  const MaterialId grey{0}, glass{1};
  room.walls.assign(5, grey);
  room.zones = {{grey, grey}};
  room.inner_walls = {{grey, {std::nullopt, glass}}, {grey, {}}};
  add(store, gondola("row", {5, 5}, 3, 0.8, {0.5, 1.2}, 30, {Face::front, Face::back}));
  add(store, Prism{"counter", {{1, 7}, {3.5, 7}, {3.5, 9.5}, {3, 9.5}, {3, 7.5}, {1, 7.5}}, {0, 1.1}, grey});
  add(store, Cylinder{"column", {10, 8}, 0.3, {}, grey});
  add(store, Panel{"screen", {Vec3{1, 4, 0}, {2, 5, 0}, {2, 5, 1.8}}, grey});
  add_devices(store, {11.9, 6, 1}, {7.5, 8, 3.1});
  return store;
}

/// Few labels and units.
struct Kiosk : PlannedShop {
  Kiosk() : PlannedShop(kiosk()) {}
};

/// A copy of one that is planned once.
struct Supermarket : PlannedShop {
  Supermarket() : PlannedShop(first()) {}
  static const PlannedShop& first() {
    static const PlannedShop shop(supermarket());
    return shop;
  }
};

// A certificate with every verdict: every 50th label is missed, every 50th undecided.
inline void certify(PlannedShop& s) {
  Certificate& certificate = s.plan.certificate.emplace();
  certificate.confidence = 0.95;
  certificate.labels.resize(s.matrix.rows());
  for (std::size_t i = 0; i < certificate.labels.size(); ++i) {
    certificate.labels[i].requirement = s.matrix.labels[i].requirement;
    certificate.labels[i].verdict = i % 50 == 7    ? Verdict::missed
                                    : i % 50 == 23 ? Verdict::undecided
                                                   : Verdict::reached;
  }
  certificate.count_lower_bound = s.placement.count() - 1;
  certificate.bound_labels = 37;
  certificate.rounds = 3;
  certificate.seconds = 12.5;
  certificate.open = {.cause = EndCause::labels_cost, .labels = 19, .seconds = 700};
}
inline void set_verdicts(PlannedShop& s, Verdict verdict) {
  for (LabelVerdict& label : s.plan.certificate->labels) label.verdict = verdict;
}

// A problem of a page without its scripts. It must be well-formed and self-contained, with valid references
// and unique ids. The requests of the page's script are tested in a browser.
inline std::string fault(const std::string& html, const Markup& markup) {
  if (!markup.problem.empty()) return markup.problem;
  for (const char* word : {"http:", "https:", "url(", "@import", "<link"})
    if (html.find(word) != std::string::npos) return std::string("holds ") + word;
  for (std::size_t at = 0; (at = html.find(" src=", at)) != std::string::npos; ++at)
    if (!std::string_view(html).substr(at).starts_with(" src=\"data:image/"))
      return "holds a source elsewhere";
  std::set<std::string> ids;
  for (const Element& element : markup.elements)
    if (element.attributes.contains("id") && !ids.insert(element["id"]).second)
      return "id twice: " + element["id"];
  for (const Element& element : markup.elements)
    if (element.attributes.contains("href"))
      if (const std::string to = element["href"]; !to.starts_with('#') || !ids.contains(to.substr(1)))
        return "dangling: " + to;
  return {};
}
inline std::string fault(const std::string& page) {
  const std::string html = without_scripts(page);
  return fault(html, read_markup(html));
}

/// A page without scripts and faults.
struct Page : Markup {
  explicit Page(const ReportInput& input) : Page(report_html(input)) {}
  explicit Page(const std::string& page) : html(without_scripts(page)) {
    static_cast<Markup&>(*this) = read_markup(html);
    EXPECT_EQ(fault(html, *this), "");
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      if (end > begin) cells.insert(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  bool has(std::string_view part) const { return html.find(part) != std::string::npos; }
  bool has_text(std::string_view part) const { return text.find(part) != std::string::npos; }
  /// From one part to the next other one, without it.
  std::string section(std::string_view begin, std::string_view end) const {
    const std::size_t at = html.find(begin);
    return at == std::string::npos ? std::string() : html.substr(at, html.find(end, at) - at);
  }

  std::string html;
  /// Texts of tables and facts, so that "8" does not match a part of another number.
  std::multiset<std::string> cells;
};

/// The rows of fields of a CSV text (RFC 4180).
inline std::vector<std::vector<std::string>> read_csv(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"') {
      row.back() += text[++at];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back(row);
      row.assign(1, "");
    } else {
      row.back() += c;
    }
  }
  return rows;
}

/// The pieces that are not in a text.
inline std::vector<std::string> missing_in(std::string_view text, std::vector<std::string> pieces) {
  std::erase_if(pieces, [&](const std::string& piece) { return text.find(piece) != text.npos; });
  return pieces;
}
inline std::vector<std::string> missing_in(const std::multiset<std::string>& cells,
                                           std::vector<std::string> pieces) {
  std::erase_if(pieces, [&](const std::string& piece) { return cells.contains(piece); });
  return pieces;
}

}  // namespace shelfbeam::test
