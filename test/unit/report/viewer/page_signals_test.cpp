#include "shelfbeam/report/viewer/page_signals.hpp"

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"

#include "unit/report/page_reader.hpp"
#include "unit/report/random_matrix.hpp"
#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::certify;
using test::PageReader;
using test::random_matrix;
using test::read_markup;
using test::Supermarket;

// The signals of a page as a dense matrix, with 0 for omitted entries.
struct Dense {
  std::size_t columns;
  std::vector<float> mean;
  std::vector<double> error, direct;  // direct is a share of the mean

  Dense(const PageSignals& s, std::size_t columns_) : columns(columns_) {
    const std::size_t entries = s.row_size.size() * columns;
    mean.assign(entries, 0);
    error.assign(entries, 0);
    direct.assign(entries, 0);
    for (std::size_t i = 0, at = 0; i < s.row_size.size(); ++i) {
      std::size_t column = 0;
      for (std::uint32_t k = 0; k < s.row_size[i]; ++k, ++at, ++column) {
        column += s.gap[at];
        const std::size_t place = i * columns + column;
        mean.at(place) = s.mean[at];
        if (!s.error.empty() && s.error[at] > 0)
          error[place] = s.min_error * std::exp((s.error[at] - 1) * s.error_step) *
                         (s.grain > 0 ? std::abs(static_cast<double>(s.mean[at])) : 1);
        if (!s.direct.empty()) direct[place] = s.direct[at] * s.direct_step;
      }
    }
  }

  double received(std::size_t label, const std::vector<bool>& chosen, const PlacementProblem& problem) const {
    std::vector<SignalEntry> row;
    for (std::uint32_t j = 0; j < columns; ++j)
      row.push_back({j, static_cast<double>(mean[label * columns + j])});
    return received_signal(row, chosen, problem);
  }
};

Placement placement_of(Selection selected, CommunicationModel model, bool redundant) {
  Placement placement;
  placement.problem.model = model;
  placement.problem.redundant = redundant;
  placement.selected = std::move(selected);
  placement.status = Status::feasible;
  return placement;
}

std::vector<bool> chosen_of(const SignalMatrix& matrix, const Placement& placement) {
  std::vector<bool> chosen(matrix.columns(), false);
  for (const std::uint32_t j : placement.selected) chosen[j] = true;
  return chosen;
}

double whole_signal(const SignalMatrix& matrix, std::size_t label, const std::vector<bool>& chosen,
                    const PlacementProblem& problem) {
  std::vector<SignalEntry> row;
  for (std::uint32_t j = 0; j < matrix.columns(); ++j) row.push_back({j, matrix.signal(label, j)});
  return received_signal(row, chosen, problem);
}

TEST(PageSignals, AreTheMatrixIfItFits) {
  const SignalMatrix matrix = random_matrix(60, 40, 1);
  const Placement placement = placement_of({3, 8, 20}, CommunicationModel::cooperative, false);
  const PageSignals signals = page_signals(matrix, placement);
  const Dense dense(signals, matrix.columns());
  EXPECT_EQ(dense.mean, matrix.mean);
  EXPECT_EQ(signals.omitted, 0U);
  EXPECT_EQ(signals.largest_effect, 0);
  EXPECT_TRUE(signals.rest.empty());
  const double step = std::expm1(0.5 * signals.error_step);
  EXPECT_LT(step, 3e-4);
  for (std::size_t k = 0; k < matrix.mean.size(); ++k) {
    const auto mean = static_cast<double>(matrix.mean[k]),
               error = static_cast<double>(matrix.standard_error[k]);
    if (mean == 0) continue;
    EXPECT_NEAR(dense.error[k], error, 1.0001 * step * error);
    EXPECT_NEAR(dense.direct[k] * mean, static_cast<double>(matrix.direct[k]), 0.50001 / 65535 * mean);
  }
}

TEST(PageSignals, AreRoundedToAShareOfTheRequirement) {
  SignalMatrix matrix = random_matrix(80, 50, 2);
  for (std::size_t at = 5; at < matrix.mean.size(); at += 97) {
    matrix.mean[at] *= -1;  // which noise of a control variate may cause
    matrix.direct[at] = 0;
  }
  const Placement placement = placement_of({1, 7, 30}, CommunicationModel::cooperative, false);
  for (const std::uint32_t fineness : {200U, 20U, 3U}) {
    const PageSignals signals = page_signals(matrix, placement, {fineness, 0, 1.2, 0.01});
    const Dense dense(signals, matrix.columns());
    const double grain = 1.0 / fineness, step = std::expm1(0.5 * signals.error_step);
    std::size_t omitted = 0, crossing = 0;
    double largest = 0, effect = 0;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
      const double need = matrix.labels[i].requirement;
      double of_label = 0;
      for (std::size_t j = 0; j < matrix.columns(); ++j) {
        const std::size_t at = matrix.at(i, j);
        const double mean = matrix.signal(i, j);
        const auto shown = static_cast<double>(dense.mean[at]);
        const double off = std::abs(mean - shown) / need;
        // Units that reach a label alone still do, and no others.
        EXPECT_EQ(is_met(shown, need), is_met(mean, need)) << i << " " << j;
        if (is_met(std::round(mean / need * fineness) * grain * need, need) != is_met(mean, need)) ++crossing;
        of_label += off;
        largest = std::max(largest, off);
        if (mean != 0 && shown == 0) {
          ++omitted;
          EXPECT_LT(mean / need, grain);
          continue;
        }
        EXPECT_LE(off, 0.5 * grain * (1 + 1e-5));
        if (mean == 0) continue;
        const auto error = static_cast<double>(matrix.standard_error[at]);
        EXPECT_NEAR(dense.error[at], error, 1.0001 * step * error);
        EXPECT_NEAR(dense.direct[at], static_cast<double>(matrix.direct[at]) / mean,
                    0.5001 * signals.direct_step);
      }
      if (of_label > effect) effect = of_label;
    }
    EXPECT_EQ(signals.omitted, omitted);
    EXPECT_GT(omitted, 0U);
    EXPECT_DOUBLE_EQ(signals.largest_error, largest);
    EXPECT_DOUBLE_EQ(signals.largest_effect, effect);
    // Negative control: rounding to the nearest grain would move some across their label's requirement.
    EXPECT_GT(crossing, 0U);
  }
}

TEST(PageSignals, KeepDetailsOfStrongSignals) {
  const SignalMatrix matrix = random_matrix(40, 30, 7);
  const Placement placement = placement_of({2, 5}, CommunicationModel::cooperative, false);
  const PageSignals signals = page_signals(matrix, placement, {50, 0.3, 1.5, 0.05});
  const Dense dense(signals, matrix.columns());
  const double step = std::expm1(0.5 * signals.error_step);
  std::size_t detailed = 0, others = 0;
  for (std::size_t at = 0; at < matrix.mean.size(); ++at) {
    const auto mean = static_cast<double>(matrix.mean[at]),
               error = static_cast<double>(matrix.standard_error[at]);
    if (dense.mean[at] == 0) continue;
    if (mean / matrix.labels[at / matrix.columns()].requirement < 0.3) {
      ++others;
      EXPECT_EQ(dense.error[at], 0);
      continue;
    }
    ++detailed;
    EXPECT_NEAR(dense.error[at], error, 1.0001 * step * error);
    EXPECT_NEAR(dense.direct[at], static_cast<double>(matrix.direct[at]) / mean, 0.0251);
  }
  EXPECT_GT(detailed, 100U);
  EXPECT_GT(others, 100U);
}

TEST(PageSignals, SwitchErrorsStayWithinTheStatedBound) {
  const SignalMatrix matrix = random_matrix(60, 40, 5);
  const Selection plan{0, 4, 9, 17, 25, 31, 38};
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (const bool redundant : {false, true}) {
      const Placement placement = placement_of(plan, model, redundant);
      const bool adds_up = model == CommunicationModel::cooperative;
      const PageSignals signals = page_signals(matrix, placement, {10, 0, 1.2, 0.01});
      const Dense dense(signals, matrix.columns());
      auto chosen = chosen_of(matrix, placement);
      double worst = 0, without_rest = 0;
      for (std::uint32_t switches = 1; switches <= matrix.columns(); ++switches) {
        const std::uint32_t unit = switches * 7 % 40;
        chosen[unit] = !chosen[unit];
        const double allowed =
            signals.largest_error * (adds_up ? switches + (redundant ? 2 : 0) : 1) * (1 + 1e-9);
        for (std::size_t i = 0; i < matrix.rows(); ++i) {
          const double need = matrix.labels[i].requirement;
          const double shown = dense.received(i, chosen, placement.problem);
          const double truth = whole_signal(matrix, i, chosen, placement.problem);
          const double off = std::abs(shown + (adds_up ? signals.rest[i] : 0) - truth) / need;
          EXPECT_LE(off, allowed) << i << " " << switches;
          EXPECT_LE(off, signals.largest_effect + (redundant && adds_up ? 2 * signals.largest_error : 1e-9));
          if (switches == 1) {
            worst = std::max(worst, off);
            without_rest = std::max(without_rest, std::abs(shown - truth) / need);
          }
        }
      }
      // Negative control: without the rounding errors of the plan's entries, one switch would exceed the
      // stated error.
      if (adds_up && !redundant) {
        EXPECT_GT(without_rest, signals.largest_error);
      }
      EXPECT_GT(worst, 0);
    }
}

TEST(PageSignals, CountThePlanAsItsFilesDo) {
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (const bool redundant : {false, true})
      for (const Rounding& rounding : {Rounding{}, Rounding{5, 0, 1.2, 0.01}}) {
        const SignalMatrix matrix = random_matrix(70, 40, 3);
        const Placement placement = placement_of({0, 4, 9, 17, 25, 31, 38}, model, redundant);
        const Outcome outcome = outcome_of(matrix, placement);
        const auto chosen = chosen_of(matrix, placement);
        const PageSignals signals = page_signals(matrix, placement, rounding);
        const Dense dense(signals, matrix.columns());
        std::size_t met = 0, without_rest = 0;
        for (std::size_t i = 0; i < matrix.rows(); ++i) {
          const double kept = dense.received(i, chosen, placement.problem);
          const double signal = kept + (signals.rest.empty() ? 0 : signals.rest[i]);
          EXPECT_DOUBLE_EQ(signal, outcome.labels[i].signal) << i;
          if (is_met(signal, matrix.labels[i].requirement)) ++met;
          if (kept == outcome.labels[i].signal) ++without_rest;
        }
        EXPECT_EQ(met, outcome.met);
        // Negative control: the rounding error is visible if it is not added again.
        if (rounding.grains_per_requirement > 0) {
          EXPECT_LT(without_rest, matrix.rows());
        }
      }
}

TEST(PageSignals, StayWithinTheirBytes) {
  const Supermarket s;
  const PackedSignals all = pack_signals(s.matrix, s.placement, 100'000'000);
  EXPECT_EQ(all.signals.grain, 0);
  double coarser = 0;
  for (const std::size_t bytes : {all.base64.size() / 3, all.base64.size() / 10, all.base64.size() / 30}) {
    const PackedSignals packed = pack_signals(s.matrix, s.placement, bytes);
    const PageSignals& signals = packed.signals;
    EXPECT_LE(packed.base64.size(), bytes);
    EXPECT_GT(packed.base64.size(), bytes * 6 / 10) << "a finer grain would fit";
    EXPECT_GT(signals.grain, coarser);
    coarser = signals.grain;
    const PageReader reader(packed.base64);
    EXPECT_EQ(reader.about["grain"], signals.grain);
    EXPECT_EQ(reader.get<double>("rest"), signals.rest);
    // As the page's script reads them.
    const auto grains = reader.get<std::uint32_t>("grains");
    ASSERT_EQ(grains.size(), signals.mean.size());
    for (std::size_t i = 0, at = 0; i < s.matrix.rows(); ++i)
      for (std::uint32_t k = 0; k < signals.row_size[i]; ++k, ++at)
        ASSERT_EQ(static_cast<float>((grains[at] + 0.5) * signals.grain * s.matrix.labels[i].requirement),
                  signals.mean[at]);
  }
  EXPECT_EQ(pack_signals(s.matrix, s.placement, all.base64.size()).signals.grain, 0);
  // Required entries are kept even without any memory.
  const PackedSignals least = pack_signals(s.matrix, s.placement, 1);
  EXPECT_EQ(least.signals.grain, 1);
  EXPECT_GT(least.signals.mean.size(), s.matrix.rows());
  EXPECT_LE(least.signals.largest_error, 1);
}

TEST(PageSignals, NeedNeitherErrorsNorDirectPart) {
  SignalMatrix matrix = random_matrix(10, 10, 4);
  matrix.standard_error.clear();
  matrix.direct.clear();
  for (const Rounding& rounding : {Rounding{}, Rounding{100, 0.3, 1.5, 0.05}}) {
    const PageSignals signals =
        page_signals(matrix, placement_of({}, CommunicationModel::cooperative, false), rounding);
    EXPECT_TRUE(signals.error.empty());
    EXPECT_TRUE(signals.direct.empty());
    if (rounding.grains_per_requirement == 0) {
      EXPECT_EQ(Dense(signals, 10).mean, matrix.mean);
    }
  }
}

TEST(PageSignals, LabelsWithoutRequirementAreRoundedAsOthers) {
  SignalMatrix matrix = random_matrix(10, 10, 6);
  matrix.labels[3].requirement = 0;
  const PageSignals signals =
      page_signals(matrix, placement_of({}, CommunicationModel::cooperative, false), {100, 0, 1.2, 0.01});
  const Dense dense(signals, 10);
  double most = 0;
  for (const LabelRow& label : matrix.labels) most = std::max(most, label.requirement);
  for (std::size_t j = 0; j < 10; ++j)
    EXPECT_NEAR(dense.mean[matrix.at(3, j)], matrix.mean[matrix.at(3, j)], 0.01 * most);
}

TEST(PageStore, NamesTheContentsOfTheReport) {
  const Supermarket s;
  const ReportData data(s.input);
  const PageReader page(pack_store(data, SignalScale({0.1, 1})));
  const auto& about = page.about;
  ASSERT_EQ(about["labels"]["ids"].size(), s.matrix.rows());
  ASSERT_EQ(about["units"]["ids"].size(), s.matrix.columns());
  EXPECT_EQ(about["units"]["selected"], s.placement.selected);
  EXPECT_EQ(about["levels"].size(), data.levels.size());
  EXPECT_EQ(about["unit"]["name"], data.unit.name);
  const auto kind = page.get<std::uint16_t>("label_kind"), level = page.get<std::uint16_t>("label_level");
  const auto position = page.get<float>("label_position");
  for (std::size_t i = 0; i < s.matrix.rows(); ++i) {
    const LabelRow& label = s.matrix.labels[i];
    EXPECT_EQ(about["labels"]["ids"][i], label.id);
    EXPECT_EQ(about["labels"]["kinds"][kind[i]]["requirement"].get<double>(), label.requirement);
    EXPECT_EQ(about["labels"]["kinds"][kind[i]]["type"], label.type);
    EXPECT_EQ(position[3 * i + 2], static_cast<float>(label.position.z));
    EXPECT_GE(label.position.z, data.levels[level[i]].low);
    EXPECT_LE(label.position.z, data.levels[level[i]].high);
  }
  EXPECT_EQ(about["labels"]["kinds"].size(), 2U);
  const auto corners = page.get<std::uint8_t>("part_corners");
  std::size_t all = 0;
  for (const std::uint8_t count : corners) all += count;
  EXPECT_EQ(page.get<float>("part_outline").size(), 2 * all);
  EXPECT_EQ(page.get<float>("part_height").size(), 2 * corners.size());
}

TEST(PageStore, HasTheVerdictsOfACertificate) {
  Supermarket s;
  const auto page = [&] { return PageReader(pack_store(ReportData(s.input), SignalScale({0.1, 1}))); };
  EXPECT_TRUE(page().about["certificate"].is_null());
  EXPECT_EQ(page().get<std::uint8_t>("label_verdict"), std::vector<std::uint8_t>());
  certify(s);
  EXPECT_EQ(page().about["certificate"]["confidence"], 0.95);
  const auto verdicts = page().get<std::uint8_t>("label_verdict");
  ASSERT_EQ(verdicts.size(), s.matrix.rows());
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    EXPECT_EQ(verdicts[i], static_cast<std::uint8_t>(s.plan.certificate->labels[i].verdict));
}

TEST(ViewerSection, HasItsData) {
  const Supermarket s;
  const std::string section = viewer_section(ReportData(s.input), "let script;");
  EXPECT_EQ(section.find("3-D view is missing"), std::string::npos);
  EXPECT_NE(section.find("exact signals of signal.h5"), std::string::npos);
  EXPECT_NE(section.find("<script>let script;</script>"), std::string::npos);
}

TEST(ViewerSection, StatesThatABuildWithoutNodeOmitsIt) {
  const Supermarket s;
  const std::string section = viewer_section(ReportData(s.input), "");
  EXPECT_EQ(test::fault(section), "");
  EXPECT_NE(read_markup(section).text.find("made without Node.js or its packages"), std::string::npos);
  EXPECT_EQ(section.find("<script"), std::string::npos);
  EXPECT_EQ(section.find("viewer-root"), std::string::npos);
}

TEST(ViewerSection, OfThisBuildIsSelfContained) {
  const Supermarket s;
  const std::string section = viewer_section(ReportData(s.input), viewer_script());
  EXPECT_LT(report_html(s.input).size(), 10'000'000U);
  if (viewer_script().empty()) {
    if (SHELFBEAM_VIEWER_WANTED != 0 && std::getenv("CI") != nullptr)
      FAIL() << "continuous integration lacks Node.js or its packages";
    GTEST_SKIP() << "this build has no 3-D view: Node.js or its packages were missing";
  }
  // The data do not end the script early.
  EXPECT_EQ(test::count_of("</script", section), 4U);
  EXPECT_EQ(section.find("<!--"), std::string::npos);
}

}  // namespace
}  // namespace shelfbeam
