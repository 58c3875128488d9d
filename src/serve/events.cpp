#include "serve/events.hpp"

#include <span>
#include <utility>

namespace shelfbeam::serve {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string name_of_shop(const Json& store, const std::string& folder) {
  const auto own = store.find("name");
  const bool is_named = own != store.end() && own->is_string() && !own->get_ref<const std::string&>().empty();
  return is_named ? own->get<std::string>() : folder;
}

std::string with_document(const Json& message, const Json& store) {
  std::string text = text_of(message);
  text.pop_back();
  return text + R"(,"json":)" + text_of(store) + "}";
}

void add_state(Json& json, const Project& project, const std::vector<Step>& all, std::size_t from) {
  Json rest = Json::array();
  for (const Step& step : std::span(all).subspan(from))
    rest.push_back({{"label", step.label}, {"time", step.time}});
  json["revision"] = project.revision();
  json["history"] = {{"from", from}, {"steps", std::move(rest)}, {"position", project.position()}};
  json["locked"] = project.locked() ? Json{{"message", *project.locked()}} : Json();
}

}  // namespace shelfbeam::serve
