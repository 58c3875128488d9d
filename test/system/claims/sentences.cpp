#include <iterator>
#include <regex>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "system/claims/claims.hpp"

namespace shelfbeam::test {

namespace {

constexpr std::string_view joint = " \n,.;:()";  // between the texts of the table

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  return parts;
}

// Adds the lines that a line with choices stands for.
void add_choices(const std::string& line, const std::string& first, std::vector<std::string>& lines) {
  const std::size_t open = line.find('['), close = line.find(']', open);
  if (open == std::string::npos) {
    lines.push_back(std::regex_replace(line, std::regex("[$]1"), first));
    return;
  }
  std::vector<std::string> choices = split(line.substr(open + 1, close - open - 1), "|");
  if (choices.size() == 1) choices.emplace_back();
  for (const std::string& choice : choices)
    add_choices(line.substr(0, open) + choice + line.substr(close + 1), first.empty() ? choice : first,
                lines);
}

// "name", "name < other" or "name = other".
bool holds(const std::string& claim, const Truth& truth) {
  const auto value = [&](const std::string& name) { return name == "1" ? 1 : truth(name); };
  if (const auto sides = split(claim, " < "); sides.size() == 2)
    return value(sides[0]) < value(sides[1]) * (1 - 1e-9);
  if (const auto sides = split(claim, " = "); sides.size() == 2) return value(sides[0]) == value(sides[1]);
  return value(claim) != 0;
}

std::function<bool(const Truth&)> condition(const std::string& text) {
  std::vector<std::vector<std::string>> ways;
  for (const std::string& way : split(text, " or ")) ways.push_back(split(way, " & "));
  return [ways](const Truth& truth) {
    return std::ranges::any_of(ways, [&](const std::vector<std::string>& claims) {
      return std::ranges::all_of(claims, [&](const std::string& claim) {
        return claim.starts_with('!') ? !holds(claim.substr(1), truth) : holds(claim, truth);
      });
    });
  };
}

Claim claim_of(const std::string& line) {
  static const std::map<std::string, Subject, std::less<>> subjects{
      {"signals", Subject::signals},
      {"certificate", Subject::certificate},
      {"reflectances", Subject::reflectances},
      {"nothing", Subject::nothing},
      {"with_addition", Subject::with_addition},
      {"without_addition", Subject::without_addition}};
  const std::vector<std::string> columns = split(line, "  ");
  Claim claim{std::regex_replace(columns.front(), std::regex(R"(\\n)"), "\n"), {}};
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const std::string& column = columns[k];
    if (column.empty() || column.front() == ' ') throw std::logic_error("three blanks in: " + line);
    if (column.starts_with("if "))
      claim.is_true = condition(column.substr(3));
    else if (column.starts_with("of "))
      claim.subject = subjects.at(column.substr(3));
    else
      claim.places.push_back(column);
  }
  return claim;
}

// The texts of a key: one, or one per number.
std::vector<std::string> texts_of(const std::string& key) {
  if (key.find_first_of(" (") != std::string::npos) return {key};
  try {
    return {std::string(english()(key))};
  } catch (const std::logic_error&) {
    return {std::string(english()(key + ".one")), std::string(english()(key + ".many"))};
  }
}

// The characters of a number at the beginning of a text: "1,019.50".
std::size_t number_length(std::string_view text) {
  std::size_t length = 0;
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  while (is_digit(length) || (length > 0 && is_digit(length - 1) && is_digit(length + 1) &&
                              (text[length] == ',' || text[length] == '.')))
    ++length;
  return length;
}

// Whether a text begins with a literal, whose last point is not part of a number.
bool begins(std::string_view text, std::string_view literal) {
  if (!text.starts_with(literal)) return false;
  const bool is_number = literal.ends_with('.') && number_length(text.substr(literal.size())) > 0;
  return !is_number;
}

double number_of(std::string text) {
  std::erase(text, ',');
  return std::stod(text);
}

bool says(const std::string& place, double said, double truth) {
  constexpr double rounding = 1e-9;
  switch (place.front()) {
    case '<':
      return said <= truth * (1 + 5 * rounding) &&
             said >= truth - std::max(0.01, 1e-5 * truth) * (1 + rounding);
    case '~':
      return std::abs(said - truth) <= 0.0051 * std::abs(truth);
    case '#':
      return std::abs(said - truth) <= 0.5 + rounding;
    case '%':
      return std::abs(said - 100 * truth) <= 0.0501;
    default:
      return std::abs(said - truth) <= rounding * std::max(1.0, std::abs(truth));
  }
}

std::string name_in(const std::string& place) {
  return place.size() > 2 && place[1] == ' ' ? place.substr(2) : place;
}

}  // namespace

const std::vector<Claim>& claims() {
  static const std::vector<Claim> all = [] {
    std::vector<Claim> list;
    for (const std::string& line :
         split(read_file(SHELFBEAM_SOURCE_DIR "/test/system/claims/claims.txt"), "\n")) {
      if (line.empty() || line.starts_with('#')) continue;
      std::vector<std::string> lines;
      add_choices(line, "", lines);
      std::ranges::transform(lines, std::back_inserter(list), claim_of);
    }
    return list;
  }();
  return all;
}

std::string with_plain_blanks(std::string text) {
  for (std::size_t at = 0; (at = text.find("\u00A0", at)) != std::string::npos;) text.replace(at, 2, " ");
  return text;
}

ClaimReader::ClaimReader() {
  for (const Claim& claim : claims())
    for (const std::string& text : texts_of(claim.key)) {
      Part part{&claim, {""}, {}};
      const auto end_part = [&] {
        std::string& first = part.literals.front();
        first.erase(0, first.find_first_not_of(joint));
        std::string& last = part.literals.back();
        last.erase(last.find_last_not_of(' ') + 1);
        const bool is_joint =
            part.places.empty() && part.literals.front().find_first_not_of(joint) == std::string::npos;
        if (!is_joint) parts_.push_back(part);
        part = {&claim, {""}, {}};
      };
      const std::string plain = with_plain_blanks(text);
      for (std::size_t at = 0; at < plain.size(); ++at) {
        if (plain[at] != '{') {
          part.literals.back() += plain[at];
          continue;
        }
        const std::string& place = claim.places.at(static_cast<std::size_t>(plain[at + 1] - '0'));
        at += 2;
        if (place == "@") {
          end_part();
        } else {
          part.places.push_back(place);
          part.literals.emplace_back();
        }
      }
      end_part();
    }
}

// The shortest words "?", as numbers have one length only.
void ClaimReader::match(const Part& part, std::string_view text, std::size_t at, std::size_t place,
                        Found& found) {
  const std::string& literal = part.literals[place];
  if (!begins(text.substr(at), literal)) return;
  at += literal.size();
  if (place == part.places.size()) {
    found.part = &part;
    found.length = at;
    return;
  }
  if (part.places[place] != "?") {
    const std::size_t length = number_length(text.substr(at));
    if (length == 0) return;
    found.values[place] = text.substr(at, length);
    found.at[place] = at;
    at += length;
    // Some arguments bring their sign, or a currency, with them.
    for (const std::string_view unit : {" EUR", " %", ""}) {
      if (text.substr(at, unit.size()) != unit) continue;
      match(part, text, at + unit.size(), place + 1, found);
      if (found.part != nullptr) return;
    }
    return;
  }
  const std::string& next = part.literals[place + 1];
  if (next.empty()) return match(part, text, text.size(), place + 1, found);
  for (std::size_t end = at; end < text.size(); ++end) {
    if (begins(text.substr(end), next)) match(part, text, end, place + 1, found);
    if (found.part != nullptr || text[end] == '\n') return;
  }
}

bool ClaimReader::is_right(const Found& found, const Truth& truth, Subject subject) try {
  const Claim& claim = *found.part->claim;
  subject = claim.subject.value_or(subject);
  for (std::size_t k = 0; k < found.part->places.size(); ++k) {
    const std::string& place = found.part->places[k];
    if (place != "?" && !says(place, number_of(found.values[k]), truth(name_in(place), subject)))
      return false;
  }
  return !claim.is_true || claim.is_true(truth);
} catch (const std::out_of_range&) {  // the result has no such value
  return false;
}

std::vector<std::string> ClaimReader::faults(std::string text, const Truth& truth, Subject subject,
                                             std::vector<std::size_t>* numbers) {
  text = with_plain_blanks(std::move(text));
  std::vector<std::string> faults;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    Found longest;
    bool is_true = false;
    for (const Part& part : parts_) {
      if (!part.literals.front().empty() && part.literals.front().front() != rest.front()) continue;
      Found found;
      found.values.resize(part.places.size());
      found.at.resize(part.places.size());
      match(part, rest, 0, 0, found);
      if (found.part == nullptr) continue;
      // Several results have the same words. The rest after a shorter true text must be true, too.
      const bool is_this_true = is_right(found, truth, subject);
      const bool is_better = is_this_true != is_true ? is_this_true : found.length > longest.length;
      if (longest.part != nullptr && !is_better) continue;
      longest = std::move(found);
      is_true = is_this_true;
    }
    if (longest.part == nullptr) {
      if (joint.find(text[at]) == std::string_view::npos) {
        faults.push_back("not in the table: " + std::string(rest.substr(0, rest.find('\n'))));
        return faults;
      }
      ++at;
      continue;
    }
    for (std::size_t k = 0; numbers != nullptr && k < longest.at.size(); ++k)
      if (longest.part->places[k] != "?") numbers->push_back(at + longest.at[k]);
    if (!is_true) faults.push_back(std::string(rest.substr(0, longest.length)));
    subject = longest.part->claim->subject.value_or(subject);
    at += longest.length;
  }
  return faults;
}

}  // namespace shelfbeam::test
