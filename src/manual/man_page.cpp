#include "man_page.hpp"

#include <sstream>

#include <fmt/format.h>

namespace shelfbeam::manual {

namespace {

// Text that roff takes as it is: no escapes, no requests at the beginning of a line, hyphens that can be
// copied.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string head(const Program& program, const std::string& name) {
  return fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n", plain(upper(name)), program.self.name,
                     program.version);
}

std::string value_of(const Argument& argument) {
  if (argument.value.empty()) return {};
  if (argument.choices.empty()) return fmt::format(" \\fI{}\\fR", plain(argument.value));
  return fmt::format(" {}", plain(fmt::format("{}", fmt::join(argument.choices, "|"))));
}

std::string entry(const Argument& argument, bool is_positional) {
  std::string names;
  for (const std::string& name : argument.names)
    names += fmt::format("{}\\f{}{}\\fR", names.empty() ? "" : ", ", is_positional ? 'I' : 'B', plain(name));
  std::string text = argument.description;
  if (is_positional && !argument.choices.empty())
    text += fmt::format("{}one of {}", text.empty() ? "" : "; ", fmt::join(argument.choices, ", "));
  if (!argument.fallback.empty()) text += fmt::format(" (default: {})", argument.fallback);
  if (argument.required && !is_positional) text += " (required)";
  return fmt::format(".TP\n{}{}\n{}\n", names, is_positional ? "" : value_of(argument), plain(text));
}

std::string section(const std::string& title, const std::vector<Argument>& arguments, bool is_positional) {
  if (arguments.empty()) return {};
  std::string text = fmt::format(".SH {}\n", title);
  for (const Argument& argument : arguments) text += entry(argument, is_positional);
  return text;
}

// What follows "Examples:" is shown as it is.
std::string footer(const std::string& text) {
  if (text.empty()) return {};
  const std::string heading = "Examples:";
  const bool has_examples = text.starts_with(heading);
  const std::string body = has_examples ? text.substr(heading.size()) : text;
  std::string lines;
  std::istringstream stream(body);
  for (std::string line; std::getline(stream, line);)
    if (const auto begin = line.find_first_not_of(' '); begin != std::string::npos)
      lines += plain(line.substr(begin)) + "\n";
  return has_examples ? fmt::format(".SH EXAMPLES\n.nf\n{}.fi\n", lines)
                      : fmt::format(".SH NOTES\n{}", lines);
}

}  // namespace

std::string man_page(const Program& program) {
  const Command& self = program.self;
  std::string text = head(program, self.name);
  text += fmt::format(".SH NAME\n{} \\- {}\n", self.name, plain(self.summary));
  text += fmt::format(".SH SYNOPSIS\n.B {}\n.I VERB\n[\\fIOPTION\\fR...]\n.SH VERBS\n", self.name);
  for (const Command& verb : program.verbs)
    text += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", plain(self.name + "-" + verb.name), plain(verb.summary));
  return text + section("OPTIONS", self.options, false) + footer(self.footer);
}

std::string man_page(const Program& program, const Command& verb) {
  const std::string name = program.self.name + "-" + verb.name;
  std::string text = head(program, name);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {} {}\n[\\fIOPTION\\fR...]", plain(name),
                      plain(verb.summary), program.self.name, plain(verb.name));
  for (const Argument& argument : verb.positionals)
    text += fmt::format(" \\fI{}\\fR", plain(argument.names.front()));
  text += "\n" + section("ARGUMENTS", verb.positionals, true) + section("OPTIONS", verb.options, false);
  return text + footer(verb.footer) + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", program.self.name);
}

}  // namespace shelfbeam::manual
