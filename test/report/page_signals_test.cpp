#include "shelfbeam/report/page_signals.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/outcome.hpp"
#include "shelfbeam/report/page_data.hpp"
#include "shelfbeam/report/page_store.hpp"
#include "shelfbeam/report/sections.hpp"

#include "page_reader.hpp"
#include "random_matrix.hpp"
#include "supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::PageReader;
using test::random_matrix;
using test::Supermarket;

TEST(PageData, ComesBackAsItWas) {
  PageData page;
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  const std::vector<std::uint16_t> words{0, 65535, 258};
  const std::vector<std::uint32_t> numbers{4294967295U, 66051};
  const std::vector<float> floats{0.1F, -1e-30F, INFINITY};
  const std::vector<double> doubles{0.1, -1e-300, 3};
  page.add("bytes", std::span(bytes));
  page.add("words", std::span(words));
  page.add("numbers", std::span(numbers));
  page.add("none", std::span(std::span<const float>()));
  page.add("floats", std::span(floats));
  page.add("doubles", std::span(doubles));
  const std::string text = page.base64(R"({"name":"Käse & <b>"})");
  const PageReader reader(text);
  EXPECT_EQ(reader.about["name"], "Käse & <b>");
  EXPECT_EQ(reader.get<std::uint8_t>("bytes"), bytes);
  EXPECT_EQ(reader.get<std::uint16_t>("words"), words);
  EXPECT_EQ(reader.get<std::uint32_t>("numbers"), numbers);
  EXPECT_EQ(reader.get<float>("none"), std::vector<float>());
  EXPECT_EQ(reader.get<float>("floats"), floats);
  EXPECT_EQ(reader.get<double>("doubles"), doubles);
  // Negative control: the reader notices what is damaged.
  std::string damaged = text;
  damaged[damaged.size() / 2] = damaged[damaged.size() / 2] == 'A' ? 'B' : 'A';
  EXPECT_ANY_THROW(PageReader{damaged});
  EXPECT_ANY_THROW(PageReader{text.substr(0, text.size() - 8)});
}

// The signals of a page as a dense matrix, 0 where an entry is left out.
struct Dense {
  std::size_t columns;
  std::vector<float> mean;
  std::vector<double> error, direct;

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
        if (!s.error.empty()) error[place] = s.error_of(s.error[at]);
        if (!s.direct.empty()) direct[place] = static_cast<double>(s.mean[at]) * s.direct[at] / 65535;
      }
    }
  }

  double received(std::size_t label, const std::vector<bool>& chosen, const Question& question) const {
    std::vector<SignalEntry> row;
    for (std::uint32_t j = 0; j < columns; ++j)
      row.push_back({j, static_cast<double>(mean[label * columns + j])});
    return received_signal(row, chosen, question);
  }
};

Placement placement_of(std::vector<std::uint32_t> selected, CommunicationModel model, bool redundant) {
  Placement placement;
  placement.question.model = model;
  placement.question.redundant = redundant;
  placement.selected = std::move(selected);
  placement.status = Status::feasible;
  return placement;
}

std::vector<bool> chosen_of(const SignalMatrix& matrix, const Placement& placement) {
  std::vector<bool> chosen(matrix.columns(), false);
  for (const std::uint32_t j : placement.selected) chosen[j] = true;
  return chosen;
}

TEST(PageSignals, AreTheMatrixWhereThereIsRoom) {
  const SignalMatrix matrix = random_matrix(60, 40, 1);
  const Placement placement = placement_of({3, 8, 20}, CommunicationModel::cooperative, false);
  const PageSignals signals = page_signals(matrix, placement, 60 * 40);
  const Dense dense(signals, matrix.columns());
  EXPECT_EQ(dense.mean, matrix.mean);
  EXPECT_EQ(signals.left_out, 0U);
  EXPECT_TRUE(signals.rest.empty());
  const double step = std::expm1(0.5 * signals.error_step);
  EXPECT_LT(step, 3e-4);
  for (std::size_t k = 0; k < matrix.mean.size(); ++k) {
    const auto mean = static_cast<double>(matrix.mean[k]),
               error = static_cast<double>(matrix.standard_error[k]);
    if (mean == 0) continue;
    EXPECT_NEAR(dense.error[k], error, 1.0001 * step * error);
    EXPECT_NEAR(dense.direct[k], static_cast<double>(matrix.direct[k]), 0.50001 / 65535 * mean);
  }
  // Negative control: with room for one entry less something is missing.
  const auto entries = signals.mean.size();
  EXPECT_EQ(page_signals(matrix, placement, entries).left_out, 0U);
  EXPECT_GT(page_signals(matrix, placement, entries - 1).left_out, 0U);
}

TEST(PageSignals, LeaveOutTheSmallestAndSayWhatThatDoes) {
  const SignalMatrix matrix = random_matrix(80, 50, 2);
  const Placement placement = placement_of({1, 7, 30}, CommunicationModel::cooperative, false);
  const auto chosen = chosen_of(matrix, placement);
  const PageSignals signals = page_signals(matrix, placement, 1500);
  const Dense dense(signals, matrix.columns());
  EXPECT_LE(signals.mean.size(), 1500U + 2 * matrix.rows());
  EXPECT_GT(signals.mean.size(), 1200U);
  std::size_t left_out = 0;
  double largest = 0, effect = 0;
  float least_kept = INFINITY;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    double of_label = 0;
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      const float mean = matrix.mean[matrix.at(i, j)], kept = dense.mean[matrix.at(i, j)];
      const double share = static_cast<double>(mean) / matrix.labels[i].requirement;
      if (kept == mean) {
        if (mean > 0 && !chosen[j]) least_kept = std::min(least_kept, static_cast<float>(share));
        continue;
      }
      EXPECT_EQ(kept, 0);
      ++left_out;
      of_label += share;
      largest = std::max(largest, share);
    }
    if (of_label > effect) {
      effect = of_label;
      EXPECT_LE(of_label, signals.largest_effect);
      if (of_label == signals.largest_effect) {
        EXPECT_EQ(signals.most_affected, i);
      }
    }
  }
  EXPECT_EQ(signals.left_out, left_out);
  EXPECT_DOUBLE_EQ(signals.largest_left_out, largest);
  EXPECT_DOUBLE_EQ(signals.largest_effect, effect);
  EXPECT_LE(static_cast<float>(largest), least_kept);
  // Whatever is on, no label gets less than the statement allows, and some label comes near it.
  const std::vector<bool> all(matrix.columns(), true);
  double worst = 0;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    double whole = 0;
    for (const float mean : matrix.mean_row(i)) whole += static_cast<double>(mean);
    const double missing =
        (whole - dense.received(i, all, placement.question)) / matrix.labels[i].requirement;
    EXPECT_LE(missing, signals.largest_effect + 1e-12);
    worst = std::max(worst, missing);
  }
  EXPECT_NEAR(worst, signals.largest_effect, 1e-12);
}

TEST(PageSignals, CountThePlanAsItsFilesDo) {
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (const bool redundant : {false, true})
      for (const std::size_t most : {400U, 100000U}) {
        const SignalMatrix matrix = random_matrix(70, 40, 3);
        const Placement placement = placement_of({0, 4, 9, 17, 25, 31, 38}, model, redundant);
        const Outcome outcome = outcome_of(matrix, placement);
        const auto chosen = chosen_of(matrix, placement);
        const PageSignals signals = page_signals(matrix, placement, most);
        const Dense dense(signals, matrix.columns());
        std::size_t met = 0, without_rest = 0;
        for (std::size_t i = 0; i < matrix.rows(); ++i) {
          const double kept = dense.received(i, chosen, placement.question);
          const double signal = kept + (signals.rest.empty() ? 0 : signals.rest[i]);
          EXPECT_EQ(signal, outcome.labels[i].signal) << i;
          if (is_met(signal, matrix.labels[i].requirement)) ++met;
          if (kept == outcome.labels[i].signal) ++without_rest;
        }
        EXPECT_EQ(met, outcome.met);
        // Negative control: of sums, what is left out is missed where it is not added again.
        if (most == 400 && model == CommunicationModel::cooperative) {
          EXPECT_LT(without_rest, matrix.rows());
        }
      }
}

TEST(PageSignals, StayWithinTheirBytes) {
  const Supermarket s;
  const PackedSignals all = pack_signals(s.matrix, s.placement, 100'000'000);
  EXPECT_EQ(all.signals.left_out, 0U);
  for (const std::size_t bytes : {all.base64.size() / 2, all.base64.size() / 10}) {
    const PackedSignals packed = pack_signals(s.matrix, s.placement, bytes);
    EXPECT_LE(packed.base64.size(), bytes);
    EXPECT_GT(packed.base64.size(), bytes * 7 / 10);
    EXPECT_GT(packed.signals.left_out, 0U);
    const PageReader reader(packed.base64);
    EXPECT_EQ(reader.get<float>("mean"), packed.signals.mean);
    EXPECT_EQ(reader.get<double>("rest"), packed.signals.rest);
    EXPECT_EQ(reader.about["leftOut"], packed.signals.left_out);
    EXPECT_EQ(reader.about["largestEffect"], packed.signals.largest_effect);
  }
  EXPECT_EQ(pack_signals(s.matrix, s.placement, all.base64.size()).signals.left_out, 0U);
  // What is always kept is, even where there is no room at all.
  const PackedSignals least = pack_signals(s.matrix, s.placement, 1);
  EXPECT_LE(least.signals.mean.size(), 2 * s.matrix.rows());
  EXPECT_GT(least.signals.mean.size(), s.matrix.rows());
  EXPECT_LT(least.signals.largest_effect, 1e9);
}

TEST(PageSignals, NeedNeitherErrorsNorDirectPart) {
  SignalMatrix matrix = random_matrix(10, 10, 4);
  matrix.standard_error.clear();
  matrix.direct.clear();
  const PageSignals signals =
      page_signals(matrix, placement_of({}, CommunicationModel::cooperative, false), 1000);
  EXPECT_TRUE(signals.error.empty());
  EXPECT_TRUE(signals.direct.empty());
  EXPECT_EQ(Dense(signals, 10).mean, matrix.mean);
}

TEST(PageStore, NamesWhatTheReportHolds) {
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

TEST(ViewerSection, HasItsDataOrSaysThatItWasLeftOut) {
  const Supermarket s;
  const std::string section = viewer_section(ReportData(s.input));
  EXPECT_EQ(section.find("was left out") == std::string::npos, has_viewer());
  EXPECT_EQ(section.find("<script") != std::string::npos, has_viewer());
  if (!has_viewer()) GTEST_SKIP() << "this build has no 3-D view: Node.js or its packages were missing";
  EXPECT_NE(section.find("to the last bit"), std::string::npos);
  // Nothing in the script ends it early.
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = section.find("</script", at)) != std::string::npos; ++at) ++ends;
  EXPECT_EQ(ends, 3U);
  EXPECT_EQ(section.find("<!--"), std::string::npos);
  EXPECT_EQ(section.find("left out"), std::string::npos);
  EXPECT_LT(report_html(s.input).size(), 10'000'000U);
}

}  // namespace
}  // namespace shelfbeam
