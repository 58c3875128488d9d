#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// A table. Cells are given as plain text.
class HtmlTable {
 public:
  /// The form on narrow screens: the table scrolls inside its box, or each row is a card with the headings.
  enum class Narrow { scroll, cards };

  struct Column {
    std::string head;
    bool number = true;  ///< right-aligned
    bool wraps = false;  ///< may break its cells into lines
  };

  explicit HtmlTable(std::vector<Column> columns, Narrow narrow = Narrow::scroll)
      : columns_(std::move(columns)), narrow_(narrow) {}
  /// `link`: the address to which the first cell leads, if it is not empty.
  void add_row(const std::vector<std::string>& cells, const std::string& link = {});
  std::string html() const;

 private:
  std::vector<Column> columns_;
  Narrow narrow_;
  std::string rows_;
};

/// The head of a page. Plain texts, except the kicker, which is HTML.
struct PageHeader {
  std::string_view tone;  ///< CSS class: "yes", "open", "no"
  std::string kicker, title, answer;
  std::vector<std::string> remarks = {};
};
std::string html_header(const PageHeader& header);

/// <section> with a heading; `body` is HTML.
std::string html_section(const std::string& id, const std::string& heading, const std::string& body);

/// <figure> with a caption; `picture` is HTML, the note below it plain text or empty.
std::string html_figure(const std::string& title, const std::string& picture, const std::string& note);

/// <ul> from plain texts.
std::string html_list(const std::vector<std::string>& items);

/// <p> from plain text.
std::string paragraph(const std::string& text, const std::string& css_class = {});

/// A page from its title (plain text) and body (HTML). The style sheet page.css serves light and dark screens
/// and paper; the colours are additional CSS variables.
std::string html_page(const Words& words, const std::string& title, const std::string& body,
                      const std::string& light_colours = {}, const std::string& dark_colours = {});

}  // namespace shelfbeam
