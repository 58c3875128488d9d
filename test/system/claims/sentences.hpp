#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "system/claims/truth.hpp"

namespace shelfbeam::test {

/// A text of the catalogue, or of the terminal, and the values of its places {0}, {1}, ...:
///
/// - "name": this number
/// - "< name": a lower bound, which may be rounded down
/// - "~ name": rounded to three digits
/// - "# name": rounded to a whole number
/// - "% name": a share, in percent with one decimal
/// - "?": words without a claim, such as ids and times
/// - "@": another text of the table
struct Claim {
  std::string key;  ///< of the catalogue, or a text that contains a blank
  std::vector<std::string> places;
  std::function<bool(const Truth&)> is_true = {};  ///< the claim beside the numbers
  std::vector<Subject> subject = {};               ///< of the rest of the text
};

/// All texts that name a bound, a count or a confidence.
const std::vector<Claim>& claims();

/// A text of a page with plain blanks in place of non-breaking ones.
std::string with_plain_blanks(std::string text);

/// A text as a sequence of the table's texts.
class ClaimReader {
 public:
  ClaimReader();

  /// The parts of a text that are not in the table, or that do not say the truth. `numbers`: if not null,
  /// gets the places of the numbers that were compared, in the text with plain blanks.
  std::vector<std::string> faults(std::string text, const Truth& truth, Subject subject,
                                  std::vector<std::size_t>* numbers = nullptr);

 private:
  // A part of a text between places "@".
  struct Part {
    const Claim* claim;
    std::vector<std::string> literals;  ///< one more than places
    std::vector<std::string> places;
  };
  struct Found {
    const Part* part = nullptr;
    std::size_t length = 0;
    std::vector<std::string> values;
    std::vector<std::size_t> at;  ///< of the values
  };
  static void match(const Part& part, std::string_view text, std::size_t at, std::size_t place, Found& found);
  static bool is_right(const Found& found, const Truth& truth, Subject subject);

  std::vector<Part> parts_;
};

}  // namespace shelfbeam::test
