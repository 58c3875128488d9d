#include "serve/project/record.hpp"

#include <limits>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/text/json_value.hpp"

namespace shelfbeam::serve {

namespace {

// A replacement may begin within a character, and comments may have any bytes.
Json bytes_json(const std::string& bytes) {
  if (is_utf8(bytes)) return bytes;
  std::string digits;
  for (const char c : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return {{"hex", digits}};
}

std::string bytes_from(const JsonCursor& json) {
  if (json.is_string()) return json.text();
  const std::string digits = json["hex"].text();
  if (digits.size() % 2 != 0 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    json.fail("is not hexadecimal");
  std::string bytes;
  for (std::size_t k = 0; k < digits.size(); k += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(k, 2), nullptr, 16));
  return bytes;
}

void expect_format(const std::string& name, const JsonCursor& format) {
  try {
    expect_format_version(name, format.integer(0, max_versions), history_format);
  } catch (const InputError& error) {
    throw OtherHistoryFormat(error);
  }
}

std::size_t size_from(const JsonCursor& json) {
  return static_cast<std::size_t>(json.natural());
}

Json json_of(const Beginning& beginning) {
  return {{"format", history_format},
          {"program", program_version()},
          {"time", beginning.time},
          {"text", bytes_json(beginning.text)},
          {"after", content_hash(beginning.text)}};
}

Json json_of(const Change& change) {
  Json json{{"time", change.time}, {"label", change.label}};
  if (!change.paths.empty()) json["paths"] = change.paths;
  if (change.joins) json["joins"] = true;
  json["before"] = change.before;
  json["after"] = change.after;
  Json& splices = json["splices"] = Json::array();
  for (const Splice& splice : change.splices)
    splices.push_back(Json::array({splice.at, bytes_json(splice.before), bytes_json(splice.after)}));
  return json;
}

Json json_of(const Move& move) {
  return {{"time", move.time}, {"position", move.position}, {"before", move.before}, {"after", move.after}};
}

Change change_from(const JsonCursor& json) {
  Change change{json["time"].text(),   json["label"].text(), {}, false, {},
                json["before"].text(), json["after"].text()};
  if (const auto paths = json.find("paths"))
    for (const JsonCursor& path : paths->elements()) change.paths.push_back(path.text());
  if (const auto joins = json.find("joins")) change.joins = joins->boolean();
  for (const JsonCursor& splice : json["splices"].elements()) {
    if (splice.size() != 3) splice.fail("is not a place with two texts");
    change.splices.push_back(
        {size_from(splice.element(0)), bytes_from(splice.element(1)), bytes_from(splice.element(2))});
  }
  return change;
}

}  // namespace

std::string line_of(const Record& record) {
  const auto write = [](const auto& entry) {
    return json_of(entry).dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  };
  return std::visit(write, record);
}

Record read_record(std::string_view line, const std::string& name) {
  const JsonCursor json = JsonCursor::parse(line, name);
  if (const auto format = json.find("format")) {
    expect_format(name, *format);
    Beginning beginning{json["time"].text(), bytes_from(json["text"])};
    if (content_hash(beginning.text) != json["after"].text()) json.fail("has another text than its hash");
    return beginning;
  }
  if (const auto position = json.find("position"))
    return Move{json["time"].text(), size_from(*position), json["before"].text(), json["after"].text()};
  return change_from(json);
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time - seconds).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), ms);
}

}  // namespace shelfbeam::serve
