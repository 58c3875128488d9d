#include "shelfbeam/report/chart/palette.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr std::array<std::array<double, 3>, 11> viridis_samples{{{68, 1, 84},
                                                                 {72, 36, 117},
                                                                 {65, 68, 135},
                                                                 {53, 95, 141},
                                                                 {42, 120, 142},
                                                                 {33, 145, 140},
                                                                 {34, 168, 132},
                                                                 {68, 191, 112},
                                                                 {122, 209, 81},
                                                                 {189, 223, 38},
                                                                 {253, 231, 37}}};

std::string symbol(const std::string& id, const std::string& content) {
  return fmt::format("<g id=\"{}\">{}</g>\n", id, content);
}

double class_share(std::size_t k, const SignalScale& scale) {
  return scale.classes() < 2 ? 1 : static_cast<double>(k) / static_cast<double>(scale.classes() - 1);
}

}  // namespace

std::string_view MarginClass::name(const Words& words) const {
  return words(key);
}

std::size_t margin_class(double margin_db, bool met) {
  std::size_t k = margin_classes.size() - 1;
  while (k > 0 && margin_db < margin_classes[k].from) --k;
  return met ? std::max<std::size_t>(k, 2) : std::min<std::size_t>(k, 1);
}

SignalScale::SignalScale(const std::vector<double>& values, std::size_t max_classes) {
  std::vector<double> positive;
  for (const double value : values)
    if (value > 0) positive.push_back(value);
  edges = positive.empty() ? std::vector<double>{1, 2}
                           : one_two_five(quantile(positive, 0.05), quantile(positive, 1));
  if (edges.size() > max_classes + 1)
    edges.erase(edges.begin(), edges.end() - static_cast<std::ptrdiff_t>(max_classes + 1));
}

std::size_t SignalScale::class_of(double signal) const {
  std::size_t k = 0;
  while (k + 1 < classes() && signal >= edges[k + 1]) ++k;
  return k;
}

std::string viridis(double t) {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(viridis_samples.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), viridis_samples.size() - 2);
  std::array<long, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] =
        std::lround(viridis_samples[low][c] + (place - static_cast<double>(low)) *
                                                  (viridis_samples[low + 1][c] - viridis_samples[low][c]));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

void define_margin_marks(SvgCanvas& canvas, double radius) {
  const double big = std::max(1.9 * radius, 8.0);
  for (std::size_t k = 0; k < margin_classes.size(); ++k) {
    const std::string id = fmt::format("m{}", k);
    const std::string shape =
        k < 2 ? fmt::format("<path class=\"k {}\" d=\"M0 {}L{} {}H{}Z\"/>", id, coordinate(-big),
                            coordinate(0.87 * big), coordinate(0.5 * big), coordinate(-0.87 * big))
              : fmt::format("<circle class=\"k {}\" r=\"{}\"/>", id, coordinate(radius));
    canvas.raw(symbol(id, shape));
  }
}

void define_hollow_mark(SvgCanvas& canvas, double radius) {
  canvas.raw(symbol("hollow", fmt::format("<circle class=\"k hollow\" r=\"{}\"/>",
                                          coordinate(std::max(0.5 * radius, 1.2)))));
  canvas.raw(symbol("hollow-key", "<use href=\"#m4\"/><use href=\"#hollow\"/>"));
}

void define_signal_marks(SvgCanvas& canvas, const SignalScale& scale, double radius) {
  // Strong signals also have larger marks, so that the maps can be read in grey.
  for (std::size_t k = 0; k < scale.classes(); ++k)
    canvas.raw(symbol(fmt::format("g{}", k),
                      fmt::format("<circle class=\"k g\" style=\"fill:var(--g{})\" r=\"{}\"/>", k,
                                  coordinate(radius * (0.75 + 0.5 * class_share(k, scale))))));
  canvas.raw(symbol("gz", fmt::format("<circle class=\"k gz\" r=\"{}\"/>", coordinate(0.6 * radius))));
}

std::string signal_colours(const SignalScale& scale, bool dark) {
  std::string css;
  for (std::size_t k = 0; k < scale.classes(); ++k) {
    const double share = class_share(k, scale);
    css += fmt::format("--g{}:{};", k, viridis(dark ? 0.12 + 0.88 * share : 0.97 * (1 - share)));
  }
  return css;
}

}  // namespace shelfbeam
