#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// A strict reader for the markup of reports: XML rules, plus HTML's void elements.
namespace shelfbeam::test {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
};

struct Markup {
  std::string problem;  ///< empty: well-formed
  std::vector<Element> elements;
  std::string text;  ///< all text between tags, without style sheets, with entities resolved
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

}  // namespace shelfbeam::test
