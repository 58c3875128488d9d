#include "jobs/preview/light_frame.hpp"

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/report/viewer/page_data.hpp"

namespace shelfbeam::jobs {

namespace {

using Json = nlohmann::ordered_json;

// The header of a message, and the position of its first array.
std::pair<Json, std::size_t> header_of(std::string_view frame) {
  std::uint32_t size = 0;
  if (frame.size() < sizeof size) throw std::out_of_range("the message is too short");
  std::memcpy(&size, frame.data(), sizeof size);
  return {Json::parse(frame.substr(sizeof size, size)), sizeof size + size};
}

template <class Value>
std::vector<Value> values_at(std::string_view frame, std::size_t at, std::size_t count) {
  std::vector<Value> values(count);
  const std::string_view bytes = frame.substr(at);
  if (bytes.size() < count * sizeof(Value)) throw std::out_of_range("the message is too short");
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(Value));
  return values;
}

}  // namespace

std::string unit_key(std::uint64_t light_key) {
  return fmt::format("{:016x}", light_key);
}

std::string column_frame(const Json& about, const Preview& column) {
  PageData page;
  page.add("signal", column.signal);
  page.add("error", column.error);
  page.add("doubts", column.doubts);
  return page.binary(about.dump());
}

Json about_of(std::string_view frame) {
  return header_of(frame).first.at("about");
}

Preview column_of(std::string_view frame) {
  const auto [header, begin] = header_of(frame);
  const auto count = header.at("arrays").at(0).at("count").get<std::size_t>();
  Preview column;
  column.signal = values_at<float>(frame, begin, count);
  column.error = values_at<float>(frame, begin + count * sizeof(float), count);
  column.doubts = values_at<std::uint8_t>(frame, begin + 2 * count * sizeof(float), count);
  return column;
}

}  // namespace shelfbeam::jobs
