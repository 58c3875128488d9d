#include "shelfbeam/report/text/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

namespace embedded {
extern const std::string_view english_text, german_text;
}  // namespace embedded

namespace {

void collect(const nlohmann::json& node, const std::string& path,
             std::map<std::string, std::string, std::less<>>& catalogue) {
  for (const auto& [name, value] : node.items()) {
    const std::string key = path.empty() ? name : fmt::format("{}.{}", path, name);
    if (value.is_string())
      catalogue.emplace(key, value.get<std::string>());
    else
      collect(value, key, catalogue);
  }
}

std::string_view file_of(Language language) {
  return language == Language::german ? embedded::german_text : embedded::english_text;
}

}  // namespace

const Words::Catalogue& Words::catalogue_of(Language language) {
  static const auto catalogues = [] {
    std::array<Catalogue, names_of<Language>.size()> all;
    for (const auto& [name, value] : names_of<Language>)
      collect(nlohmann::json::parse(file_of(value)), "", all[static_cast<std::size_t>(value)]);
    return all;
  }();
  return catalogues[static_cast<std::size_t>(language)];
}

Words::Words(Language language) : language_(language), catalogue_(&catalogue_of(language)) {}

std::string_view Words::operator()(std::string_view key) const {
  const auto found = catalogue_->find(key);
  if (found == catalogue_->end())
    throw std::logic_error(fmt::format("the text catalogue of '{}' has no '{}'", to_text(language_), key));
  return found->second;
}

std::string Words::viewer_json() const {
  return nlohmann::json::parse(file_of(language_)).at("viewer").dump();
}

std::string Words::localised(std::string number) const {
  if (language_ == Language::german)
    for (char& c : number) c = c == '.' ? ',' : c == ',' ? '.' : c;
  return number;
}

std::string Words::grouped(std::uint64_t count) const {
  return localised(shelfbeam::grouped(count));
}

std::string Words::fixed(double value, int decimals) const {
  return localised(fixed_number(value, decimals));
}

std::string Words::significant(double value, int digits) const {
  return localised(significant_number(value, digits));
}

std::string Words::plain(double value, int digits) const {
  return localised(plain_number(value, digits));
}

std::string Words::plain_down(double value) const {
  constexpr int digits = 6;
  if (value == 0 || !std::isfinite(value)) return plain(value);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return plain(rounded_down(value, digits - 1 - exponent));
}

std::string Words::percent(double share, int decimals) const {
  return fixed(100 * share, decimals) + "\u00A0%";
}

std::string Words::confidence_text(double confidence) const {
  constexpr int decimals = 4;
  return plain(rounded_down(100 * confidence, decimals));
}

std::string Words::decibels(double value, int decimals) const {
  if (std::isinf(value)) return say(value < 0 ? "margin.no_signal" : "margin.no_requirement");
  // Two decimals for a small margin, which would otherwise read as 0.0 dB.
  const std::string text = fixed_number(value, std::abs(value) < 0.095 ? std::max(decimals, 2) : decimals);
  return (value > 0 && text != "0.00" ? "+" : "") + localised(text) + "\u00A0dB";
}

Words words_of(const Scene& scene) {
  return Words(scene.language);
}

}  // namespace shelfbeam
