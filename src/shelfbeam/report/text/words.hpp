#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/locale/language.hpp"

namespace shelfbeam {

struct Scene;

/// The texts of a report in one language, from english.json or german.json, and numbers as that language
/// writes them. Keys are paths ("mounting.title"). A small value that refers to a table made once.
class Words {
 public:
  explicit Words(Language language);

  Language language() const { return language_; }

  /// The text with this key. Throws std::logic_error for a key that is missing.
  std::string_view operator()(std::string_view key) const;

  /// Fills the places {0}, {1}, ... of a text.
  template <class... Args>
  std::string say(std::string_view key, const Args&... args) const {
    return fmt::format(fmt::runtime((*this)(key)), args...);
  }

  /// The text with the key `key`.one for a count of 1, otherwise `key`.many; {0} is the count.
  template <class... Args>
  std::string say_count(std::string_view key, std::uint64_t count, const Args&... args) const {
    return say(fmt::format("{}.{}", key, count == 1 ? "one" : "many"), grouped(count), args...);
  }

  /// The texts of the 3-D view, as JSON.
  std::string viewer_json() const;

  /// 12345 -> "12,345".
  std::string grouped(std::uint64_t count) const;

  /// Fixed decimals with the minus sign U+2212, never "-0".
  std::string fixed(double value, int decimals) const;

  /// At least `digits` significant digits as a plain decimal; powers of ten only below 1e-4 and from 1e7 on.
  std::string significant(double value, int digits = 3) const;

  /// Up to `digits` significant digits without trailing zeros: for round numbers such as ticks and edges.
  std::string plain(double value, int digits = 6) const;

  /// As `plain`, rounded down.
  std::string plain_down(double value) const;

  /// A share in percent: 0.166 -> "16.6 %".
  std::string percent(double share, int decimals = 1) const;

  /// A confidence in percent, rounded down: 0.999 -> "99.9".
  std::string confidence_text(double confidence) const;

  /// "+3.2 dB", two decimals at least near zero; "no signal" for minus infinity, "no requirement" for plus
  /// infinity.
  std::string decibels(double value, int decimals = 1) const;

 private:
  using Catalogue = std::map<std::string, std::string, std::less<>>;

  static const Catalogue& catalogue_of(Language language);
  std::string localised(std::string number) const;

  Language language_;
  const Catalogue* catalogue_;
};

/// In the language of the store.
Words words_of(const Scene& scene);

/// For the terminal, and for pages about stores of several languages.
inline Words english() {
  return Words(Language::english);
}

}  // namespace shelfbeam
