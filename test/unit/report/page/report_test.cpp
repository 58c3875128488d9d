#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

using testing::IsEmpty;

TEST(Markup, ReaderRejectsBrokenMarkup) {
  EXPECT_EQ(read_markup("<p class=\"a\">x &amp; y<br></p>").problem, "");
  for (const char* broken : {"<p>", "<p></b>", "a & b", "<p class=a></p>", "<p class=\"<\"></p>", "a < b",
                             "a > b", "<p a=\"1\" a=\"2\"></p>", "<use href=\"#x\"></g>"})
    EXPECT_NE(read_markup(broken).problem, "") << broken;
  for (const char* wrong : {"<svg><use href=\"#missing\"/></svg>", "<img src=\"http://example.com/x.png\">",
                            "<script src=\"x.js\"></script>", "<p id=\"a\"></p><p id=\"a\"></p>"})
    EXPECT_NE(fault(wrong), "") << wrong;
  EXPECT_EQ(fault("<script>a < b && c</script>"), "");
  EXPECT_EQ(without_scripts("<p>a</p><script id=\"x\">b</script>c"), "<p>a</p><script id=\"x\"></script>c");
}

TEST(ReportHtml, IsOneSelfContainedPage) {
  const Supermarket s;
  const std::string html = report_html(s.input);
  EXPECT_EQ(fault(html), "");
  EXPECT_EQ(html, report_html(s.input));
}

TEST(ReportHtml, EscapesIdsAndNames) {
  Kiosk s;
  s.placement.solver = {Method::mip, "<solver>"};
  const Page page(s.input);
  EXPECT_THAT(missing_in(page.text, {"Joe's <Kiosk> & \"Bar\"", "A<1>-front-1-1", "T,2", "<solver>"}),
              IsEmpty());
  for (const char* raw : {"<Kiosk>", "A<1>", "<solver>"}) EXPECT_FALSE(page.has(raw)) << raw;
}

TEST(ReportHtml, ContainsEveryComputedNumber) {
  const Supermarket s;
  const ReportData data(s.input);
  std::vector<std::string> cells{s.placement.solver.backend.value(), s.matrix.provenance.estimator,
                                 s.matrix.provenance.store_hash, "940\u00A0nm"};
  for (const UnitOutcome& unit : data.outcome.units) {
    cells.push_back(data.transceiver(unit.column).id);
    for (const std::size_t count : {unit.reaches_alone, unit.strongest_for, unit.needed_by})
      cells.push_back(grouped(count));
  }
  for (std::size_t k = 0; k < 20; ++k) {
    const std::uint32_t row = data.outcome.by_margin[k];
    const LabelOutcome& label = data.outcome.labels[row];
    cells.push_back(data.label(row).id);
    cells.push_back(english().decibels(label.margin()));
    cells.push_back(data.unit.number(label.signal));
    cells.push_back(
        data.unit.number(static_cast<double>(s.matrix.standard_error[s.matrix.at(row, *label.strongest)])));
  }
  for (std::size_t k = 0; k < data.levels.size(); ++k)
    cells.push_back(fmt::format("Level {}: {} ({})", k + 1, data.levels[k].heights(english()),
                                grouped(data.levels[k].labels.size())));
  const SamplingSummary& sampling = data.sampling;
  cells.push_back(grouped(sampling.min_samples));
  cells.push_back(grouped(sampling.relevant));

  const std::string labels = grouped(data.outcome.labels.size());
  const ExcessDistribution excess = excess_distribution(data.outcome);
  std::vector<std::string> parts{
      "all " + grouped(data.outcome.met) + " labels receive enough signal",
      grouped(data.outcome.redundant) + " of " + labels + " (",
      grouped(sampling.zeros) + " of " + grouped(sampling.entries),
      grouped(data.outcome.met_by_direct_light) + " of " + labels,
      fmt::format("Median {}\u00A0%, mean {}", english().significant(excess.median),
                  english().significant(excess.mean))};
  for (const double share : {sampling.mean, sampling.median, sampling.p90, sampling.p99, sampling.worst})
    parts.push_back(english().percent(share));
  for (const double q : {0.1, 0.5, 0.9})
    parts.push_back(english().percent(quantile(data.outcome.direct_shares(), q)));

  const Page page(s.input);
  EXPECT_THAT(missing_in(page.cells, cells), IsEmpty());
  EXPECT_THAT(missing_in(page.text, parts), IsEmpty());
  EXPECT_FALSE(page.cells.contains(grouped(data.outcome.met + 1))) << "a number that was not computed";
}

TEST(ReportHtml, HasTheNumbersOfTheCertificate) {
  Supermarket s;
  certify(s);
  const Certificate& certificate = *s.plan.certificate;
  const Page page(s.input);
  const std::string reached = grouped(certificate.count(Verdict::reached));
  EXPECT_THAT(missing_in(page.cells, {"95\u00A0%", reached + " of 926", "37 labels",
                                      end_text(english(), *certificate.open)}),
              IsEmpty());
  EXPECT_THAT(
      missing_in(page.text, {"Rounds\n\n3\n",
                             fmt::format("Lower bound on the count\n\n{}\n", certificate.count_lower_bound),
                             "confidence that " + reached + " of 926 labels receive enough signal.",
                             "Missed\n\n19: 2 on A1, ", "Undecided\n\n19: 2 on A1, "}),
      IsEmpty());
  // The labels with the smallest margins have their verdicts in the table.
  const ReportData data(s.input);
  const std::string table = page.html.substr(page.html.find("id=\"weakest\""));
  for (std::size_t k = 0, at = 0; k < 20; ++k) {
    const std::uint32_t row = data.outcome.by_margin[k];
    at = table.find("<tr><td>" + escape(data.names.name(row)) + "</td>", at);
    ASSERT_NE(at, std::string::npos) << data.names.name(row);
    const std::string line = table.substr(at, table.find("</tr>", at) - at);
    const auto verdict = std::string(to_text(certificate.labels[row].verdict));
    EXPECT_NE(line.find(">" + verdict + "<"), std::string::npos) << line;
  }
}

TEST(ReportHtml, StatesAValidCertificate) {
  Kiosk s;
  certify(s), set_verdicts(s, Verdict::reached);
  s.plan.certificate->open.reset();
  EXPECT_THAT(missing_in(Page(s.input).text, {"Verified", "Missed\n\nnone\n"}), IsEmpty());
  s.plan.certificate->labels[5].verdict = Verdict::missed;
  const Page missed(s.input);
  EXPECT_FALSE(missed.has_text("Verified"));
  EXPECT_TRUE(missed.has_text("Missed\n\n1: " + ReportData(s.input).names.name(5) + "\n"));
}

TEST(ReportHtml, MarksPlansWithoutACertificate) {
  Kiosk s;
  const std::string_view mark = english()("certificate.lacking");
  EXPECT_EQ(count_of(mark, Page(s.input).text), 3U) << "summary, mounting sheet and details";
  EXPECT_EQ(count_of(mark, mounting_dxf(s.input)), 1U);
  certify(s);
  EXPECT_EQ(count_of(mark, Page(s.input).text + mounting_dxf(s.input)), 0U);
}

TEST(ReportHtml, NamesTheSeedsOfPlanAndSignals) {
  Kiosk s;
  s.matrix.provenance.seed = 8'231;
  for (const auto& [of_plan, cell] : {std::pair<std::optional<std::uint64_t>, const char*>{{}, "8231"},
                                      {8'231, "8231"},
                                      {8'232, "8232; 8231 of the signals"}}) {
    s.plan.seed = of_plan;
    EXPECT_TRUE(Page(s.input).cells.contains(cell)) << cell;
  }
}

// The page contains sections for this kind of problem and result, and no others.
TEST(ReportHtml, HasTheSectionsOfTheResult) {
  struct Case {
    std::function<void(Kiosk&)> change;
    std::vector<std::string> pieces;
  };
  const auto infeasible = [](Placement& p, const PlacementProblem& problem,
                             std::vector<Unreachable> unreachable) {
    p = {};
    p.problem = problem;
    p.status = Status::infeasible;
    p.unreachable = std::move(unreachable);
  };
  const Page usual(Kiosk().input);
  for (const auto& [change, wanted] : std::vector<Case>{
           {[](Kiosk& s) { s.placement.problem.objective = Objective::links; }, {"Gap of the objective"}},
           {[](Kiosk& s) { s.placement.status = Status::stopped; }, {"stopped early"}},
           {[](Kiosk& s) { s.placement.min_spacing = 17.5, s.placement.forbidden_pairs = 1200; },
            {"Minimum distance between units", "17.5\u00A0m", "Excluded pairs of candidates", "1,200"}},
           {[](Kiosk& s) { s.placement.bound_proof = BoundProof::log, s.placement.ties_settled = true; },
            {std::string(bound_proof_text(english(), BoundProof::log)),
             "this one has the largest minimum margin"}},
           {[](Kiosk& s) { s.placement.problem.redundant = true; },
            {"signals without each label's strongest unit"}},
           {[](Kiosk& s) { std::fill(s.matrix.direct.begin(), s.matrix.direct.end(), 0.0F); },
            {"one label in ten receives no direct light"}},
           {[&](Kiosk& s) { infeasible(s.placement, {}, {}); }, {"No selection reaches all labels."}},
           {[&](Kiosk& s) {
              infeasible(s.placement, {.model = CommunicationModel::non_cooperative, .redundant = true},
                         {{3, 1, 0}, {4, 2, 1}});
            },
            {std::string(no_signal_reason(english(), {.redundant = true}, true)), "3.0\u00A0dB",
             "The maximum signal is the signal that the label would receive from the best single candidate "
             "that remains if the strongest fails."}}}) {
    Kiosk s;
    change(s);
    EXPECT_THAT(missing_in(Page(s.input).text, wanted), IsEmpty());
    EXPECT_EQ(missing_in(usual.text, wanted), wanted);
  }
}

TEST(ReportHtml, EveryLabelIsMarkedOnceOnThePlans) {
  const Supermarket s;
  const ReportData data(s.input);
  const std::string text = report_html(s.input);
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); i += 37) {
    const LabelOutcome& label = data.outcome.labels[i];
    const std::string title = fmt::format("<title>{}: {}, {}</title>", data.names.name(i),
                                          data.unit.text(label.signal), english().decibels(label.margin()));
    EXPECT_EQ(count_of(title, text), 1U) << title;
  }
}

TEST(ReportHtml, MarksLabelsThatDependOnFlaggedSignals) {
  Supermarket s;
  const auto hollow = [](const Page& page) {
    return std::ranges::count_if(page.elements, [](const Element& element) {
      return element["href"] == "#hollow" && element.attributes.contains("x");
    });
  };
  const Page unknown(s.input);
  EXPECT_EQ(hollow(unknown), 0);
  EXPECT_FALSE(unknown.cells.contains("Entries with an unreliable error"));
  s.matrix.flags.assign(s.matrix.mean.size(), 0);
  const Page none(s.input);
  EXPECT_EQ(hollow(none), 0);
  EXPECT_TRUE(none.cells.contains("0 (0.0\u00A0%)"));
  for (const char* text : {"hollow mark", "(not reliable)", "error not reliable: "})
    EXPECT_FALSE(none.has(text)) << text;

  const std::uint32_t least = ReportData(s.input).outcome.by_margin.front();
  for (std::size_t j = 0; j < s.matrix.columns(); ++j) s.matrix.flags[s.matrix.at(least, j)] = 1;
  const SamplingSummary sampling = ReportData(s.input).sampling;
  EXPECT_GT(sampling.flagged, 0U);
  EXPECT_LT(sampling.flagged, s.matrix.columns());
  const Page one(s.input);
  EXPECT_EQ(hollow(one), 1);
  const double share = static_cast<double>(sampling.flagged) / static_cast<double>(sampling.relevant);
  EXPECT_THAT(missing_in(one.cells, {fmt::format("{} ({})", sampling.flagged, english().percent(share)),
                                     "error not reliable: 1"}),
              IsEmpty());
  EXPECT_THAT(missing_in(one.html, {"The label with a hollow mark depends on", " (not reliable)</td>"}),
              IsEmpty());
}

TEST(ReportHtml, ListsTheLabelsThatEachUnitServes) {
  const Supermarket s;
  const ReportData data(s.input);
  const std::string list = Page(s.input).section("<details>", "</details>");
  std::size_t counts = 0, at = 0;
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    at = list.find(fmt::format("<dt>{}: ", k + 1), at);
    ASSERT_NE(at, std::string::npos) << k;
    for (const std::string& count : data.names.counts(data.outcome.served_by(k))) {
      ++counts;
      at = list.find("<li>" + escape(count) + "</li>", at);
      ASSERT_NE(at, std::string::npos) << k << " " << count;
    }
  }
  EXPECT_GT(counts, data.outcome.units.size());
  EXPECT_EQ(count_of("<li>", list), counts);
}

TEST(ReportHtml, ShowsTheAimOfChosenUnits) {
  Kiosk s;
  const std::uint32_t unit = s.placement.selected.front();
  struct Case {
    Vec3 axis;
    double roll_deg;
    const char* text;
    bool is_marked;  // in plan
  };
  for (const auto& [axis, roll_deg, text, is_marked] :
       {Case{{0, 0, -1}, 0, "down", false},
        {{std::sqrt(0.75), 0, -0.5}, 0, "60.0° towards 0.0°", true},
        {{0, -std::sqrt(0.5), -std::sqrt(0.5)}, 0, "45.0° towards 270.0°", true},
        {{0, 0, 1}, 0, "up", false},
        {{0, 1, 0}, 30, "90.0° towards 90.0°, roll 30°", true}}) {
    s.matrix.transceivers[unit].axis = axis;
    s.scene.transceivers[unit].roll_deg = roll_deg;
    const Page page(s.input);
    EXPECT_TRUE(page.cells.contains(text)) << text;
    // One is in the legend.
    EXPECT_EQ(count_of("\"k aim\"", page.html), is_marked ? 2U : 1U) << text;
    EXPECT_EQ(page.cells.contains("tilted this way"), is_marked) << text;
  }
}

TEST(ReportHtml, ExplainsInfeasibility) {
  Supermarket s;
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  std::vector<double> reserves;  // if every candidate were switched on
  for (const LabelOutcome& label : outcome.labels) reserves.push_back(label.best / label.requirement);
  std::ranges::sort(reserves);
  s.placement = {};
  s.placement.status = Status::infeasible;
  s.placement.count_lower_bound = s.placement.lower_bound = s.placement.objective_value = INFINITY;
  for (std::uint32_t i = 0; i < s.matrix.rows(); ++i) {
    s.matrix.labels[i].requirement *= reserves[10];
    if (outcome.labels[i].best < s.matrix.labels[i].requirement)
      s.placement.unreachable.push_back({i, s.matrix.labels[i].requirement, outcome.labels[i].best});
  }
  ASSERT_EQ(s.placement.unreachable.size(), 10U);
  const Page page(s.input);
  const ReportData data(s.input);
  std::vector<std::string> cells;
  for (const Unreachable& label : s.placement.unreachable) {
    cells.push_back(data.names.name(label.label));
    cells.push_back(data.unit.number(label.max_signal));
  }
  EXPECT_THAT(missing_in(page.cells, cells), IsEmpty());
  // Triangles on the plans: one per missed label, and no others.
  const auto triangles = std::ranges::count_if(page.elements, [](const Element& element) {
    return (element["href"] == "#m0" || element["href"] == "#m1") && element.attributes.contains("x");
  });
  EXPECT_EQ(triangles, 2 * std::ssize(s.placement.unreachable));
  for (const char* odd : {"∞", ">inf<", ">nan"}) EXPECT_FALSE(page.has(odd)) << odd;
}

TEST(ReportHtml, ReadsWellWithoutSelectionErrorsOrDirectPart) {
  Kiosk s;
  s.matrix.standard_error.clear();
  s.matrix.direct.clear();
  EXPECT_TRUE(Page(s.input).has("contains no standard errors"));
  s.placement = {};
  s.placement.count_lower_bound = 3;
  s.placement.seconds = 60;
  const Page page(s.input);
  for (const char* odd : {">nan", " nan", "∞"}) EXPECT_FALSE(page.has(odd)) << odd;
}

TEST(ReportHtml, StaysSmallForFiveThousandLabels) {
  Store store = empty_store("Large", {60, 40, 4});
  for (int k = 0; k < 25; ++k) {
    Gondola row = gondola(fmt::format("A{}", k), {5, 1.0 + 1.5 * k}, 50, 0.9, {0.3, 0.7, 1.1, 1.5, 1.9}, 0,
                          {Face::front});
    row.labels->spacing = 1.25;
    add(store, row);
  }
  store.grids = {{{{5, 5}, {55, 35}, 10, 3.9, {0, 0, -1}, 0, {}}, "store.json: transceivers.grids[0]"}};
  const Scene scene = make_scene(store);
  ASSERT_EQ(scene.labels.size(), 5000U);
  const SignalMatrix matrix = matrix_of(scene);
  CertifiedPlan plan;
  plan.placement.status = Status::feasible;
  plan.placement.selected = {0, 5, 9, 14, 20};
  EXPECT_LT(Page(ReportInput{scene, matrix, plan}).html.size(), 1'000'000U);
}

Sensitivity made_up() {
  Sensitivity made;
  made.as_given = {1.25, 0.0125, 3};
  made.low = {{0.5, 0.005, 7}, {7, 8, 9}, {11}};
  made.high = {{1.75, 0.01, 4}, {}, {}};
  for (const char* name : {"tiles <grey>", "carton"}) {
    MaterialSensitivity one{name, 0.6, 0.45, 0.75, made.materials.empty(), {}, {}};
    one.at_lower = {{0.8, 0.008, 5}, -0.375, 0.00131, -0.0621, 2};
    one.at_upper = {{1.6, 0.008, 6}, 0.25, 0.00131, 0.0878, 0};
    made.materials.push_back(one);
  }
  made.kept = {"glass"};
  made.watched = 16;
  return made;
}

TEST(PlanSections, ShowTheEffectOfReflectances) {
  Kiosk s;
  const Page without(s.input);
  for (const char* id : {"id=\"sensitivity\"", "id=\"curve\""}) EXPECT_FALSE(without.has(id));
  s.plan.sensitivity = made_up();
  const Page page(s.input);
  EXPECT_THAT(missing_in(page.text, {"16 of 20 labels are reached with", "10\u00A0% to both sides is assumed",
                                     "their reflectance: glass", "16 labels with the smallest margins",
                                     "3 labels missed at the low end", "1 label undecided at the low end"}),
              IsEmpty());
  EXPECT_THAT(missing_in(page.cells, {"0.6 (0.45 to 0.75) *", "0.6 (0.45 to 0.75)", "−0.97\u00A0dB",
                                      "−37.5\u00A0% (±\u00A00.13)", "−6.2\u00A0%", "+8.8\u00A0%",
                                      ReportData(s.input).names.name(5)}),
              IsEmpty());
  EXPECT_FALSE(page.cells.contains("−6.4\u00A0%")) << "nothing that is not in it";
  EXPECT_EQ(count_of("class=\"bar short\"><title>all together: ", page.html), 1U);
}

TEST(PlanSections, StateThatAPlanHolds) {
  Kiosk s;
  s.plan.sensitivity = made_up();
  s.plan.sensitivity->low = {{1.0625, 0.01, 2}, {}, {}};
  for (MaterialSensitivity& one : s.plan.sensitivity->materials) one.at_upper.mean_change = 1e-5;
  const Page page(s.input);
  EXPECT_FALSE(page.has("missed at the low end"));
  EXPECT_TRUE(page.cells.contains("0.0\u00A0%"));
  EXPECT_FALSE(page.cells.contains("+0.0\u00A0%"));
}

// A label without light has no margin in decibels, but its bar must end.
TEST(PlanSections, DrawMarginsOfNothing) {
  Kiosk s;
  s.plan.sensitivity = made_up();
  s.plan.sensitivity->low.min_margin.ratio = 0;
  const Page page(s.input);
  for (const char* broken : {"nan\"", "inf\""}) EXPECT_FALSE(page.has(broken));
  EXPECT_EQ(tornado_svg(english(), {}), "");
}

TEST(PlanSections, ShowTheCoverageOfFewerUnits) {
  Kiosk s;
  for (std::size_t k = 1; k <= 19; ++k) s.plan.curve.points.push_back({k, k, k + 1});
  const Page page(s.input);
  EXPECT_THAT(missing_in(page.cells, {"95.0\u00A0%", "100.0\u00A0%"}), IsEmpty());
  EXPECT_TRUE(page.has("19 transceivers: at least 95.0"));
  EXPECT_FALSE(page.has("stopped early; more time"));
  s.plan.curve.points.resize(1);
  s.plan.curve.is_complete = false;
  const Page stopped(s.input);
  EXPECT_TRUE(stopped.has("stopped early; more time"));
  EXPECT_FALSE(stopped.has("Labels reached by fewer transceivers")) << "one point is no curve";
}

// The pieces of a catalogue's texts between their places. Pieces too short to belong to one language are left
// out.
void collect_pieces(const nlohmann::json& node, std::set<std::string>& pieces) {
  constexpr std::size_t shortest = 9;
  if (!node.is_string()) {
    for (const nlohmann::json& value : node) collect_pieces(value, pieces);
    return;
  }
  const auto text = node.get<std::string>();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('{', begin), text.size());
    if (end - begin >= shortest) pieces.insert(text.substr(begin, end - begin));
    begin = std::min(text.find('}', end), text.size()) + 1;
  }
}

std::set<std::string> pieces_of(const char* file) {
  std::set<std::string> pieces;
  auto catalogue = nlohmann::json::parse(
      read_file(std::string(SHELFBEAM_SOURCE_DIR "/src/shelfbeam/report/text/") + file));
  catalogue.erase("viewer");
  collect_pieces(catalogue, pieces);
  return pieces;
}

// The English pieces in a text that occur in no German one.
std::vector<std::string> english_in(const std::string& text) {
  static const std::set<std::string> english = pieces_of("english.json"), german = pieces_of("german.json");
  std::vector<std::string> found;
  for (const std::string& piece : english)
    if (text.find(piece) != std::string::npos &&
        std::ranges::none_of(german, [&](const std::string& one) { return one.find(piece) != one.npos; }))
      found.push_back(piece);
  return found;
}

// A comma instead of a point in a coordinate would change a drawing.
std::vector<std::string> geometry(const Page& page) {
  std::vector<std::string> values;
  for (const Element& element : page.elements)
    for (const char* name : {"d", "x", "y", "points", "transform", "viewBox", "style"})
      if (!element[name].empty()) values.push_back(element[name]);
  return values;
}

TEST(LanguageOfReport, IsThatOfTheStoreAndDoesNotChangeDrawings) {
  Supermarket s;
  certify(s);
  const Page english(s.input);
  EXPECT_GT(english_in(english.text).size(), 50U) << "the control";
  s.scene.language = Language::german;
  const std::string html = report_html(s.input);
  const Page german(html);
  EXPECT_THAT(english_in(german.text), IsEmpty());
  EXPECT_THAT(english_in(floor_plan_svg(s.scene)), IsEmpty());
  const std::string sheet = mounting_csv(s.input);  // columns have the same names in all languages
  EXPECT_THAT(english_in(sheet.substr(sheet.find('\n'))), IsEmpty());
  EXPECT_THAT(english_in(mounting_dxf(s.input)), IsEmpty());
  EXPECT_TRUE(german.has("<html lang=\"de\">"));
  EXPECT_NE(html.find("\"Schließen\""), std::string::npos) << "the texts of the 3-D view";
  EXPECT_EQ(geometry(german), geometry(english));
  EXPECT_GT(geometry(english).size(), 100U);
}

}  // namespace
}  // namespace shelfbeam::test
