#include "serve/request.hpp"

#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json_parser.hpp"

namespace shelfbeam::serve {

std::string Request::text(const char* key) const {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) throw InputError(key, "is no text", "");
  return found->get<std::string>();
}

std::size_t Request::number(const char* key) const {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number_unsigned()) throw InputError(key, "is no whole number", "");
  return found->get<std::size_t>();
}

std::vector<EditOp> Request::ops() const {
  const auto list = json.find("ops");
  if (list == json.end() || !list->is_array()) throw InputError("ops", "is no list", "");
  std::vector<EditOp> ops;
  for (const Json& op : *list) {
    const Request part{tab, op};
    const auto value = [&](const char* key) {
      const auto found = op.find(key);
      return found == op.end() ? std::nullopt : std::optional(*found);
    };
    ops.push_back({part.text("path"), value("before"), value("after")});
  }
  return ops;
}

Json json_of(const std::vector<EditOp>& ops) {
  Json list = Json::array();
  for (const EditOp& op : ops) {
    Json one{{"path", op.path}};
    if (op.before) one["before"] = *op.before;
    if (op.after) one["after"] = *op.after;
    list.push_back(std::move(one));
  }
  return list;
}

Json error_json(const InputError& error) {
  Json json{{"message", error.what()}};
  if (const auto* conflict = dynamic_cast<const EditConflict*>(&error)) json["path"] = conflict->path();
  return json;
}

Json message_of(std::string_view text) {
  try {
    return parse_json(text, "the message", max_document);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace shelfbeam::serve
