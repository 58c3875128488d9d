#include "shelfbeam/placement/io/record.hpp"

#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::uint32_t Ids::position(const std::string& id, const JsonCursor& member) const {
  const auto found = positions_.find(id);
  if (found == positions_.end())
    member.fail(fmt::format("names {}, but the matrix has no such {}", in_quotes(id), what_),
                "use the matrix that this placement was computed from");
  return found->second;
}

std::optional<JsonCursor> Record::find(std::string_view key) {
  const bool may_be_missing = std::exchange(is_later_, false);
  if (file_ == nullptr) {
    keys_.push_back(key);
    return {};
  }
  return may_be_missing ? file_->find(key) : (*file_)[key];
}

void Record::number(std::string_view key, double& value, Json (*to_json)(double)) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  custom(
      key, [&] { return to_json(value); },
      [&](const JsonCursor& json) { value = json.is_null() ? infinity : json.non_negative(); });
}

void Record::id(std::string_view key, LabelId& position, const Ids& ids) {
  custom(
      key, [&] { return Json(ids[position]); },
      [&](const JsonCursor& json) { position = ids.position(json); });
}

void Record::texts(std::string_view key, std::vector<std::string>& texts) {
  value(key, texts, [](const JsonCursor& json) {
    std::vector<std::string> read;
    for (const JsonCursor& text : json.elements()) read.push_back(text.text());
    return read;
  });
}

}  // namespace shelfbeam::detail
