#include "shelfbeam/scene/field_writer.hpp"

namespace shelfbeam {

bool FieldWriter::references(std::string_view key, NameList,
                             std::vector<std::pair<std::string, std::uint32_t>>& values, const Field& field) {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const auto& [name, index] : values) names[name] = materials_[index].name;
  return write(key, names, field);
}

bool FieldWriter::object(std::string_view key, const Part& part, const Field& field) {
  if (!field.is_written) return false;
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  FieldWriter writer(object, materials_);
  part(writer);
  return write(key, object, field);
}

bool FieldWriter::objects(std::string_view key, std::size_t count,
                          const std::function<void(Fields&, std::size_t)>& part, const Field& field) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; field.is_written && k < count; ++k) {
    FieldWriter writer(list.emplace_back(nlohmann::ordered_json::object()), materials_);
    part(writer, k);
  }
  return write(key, list, field);
}

}  // namespace shelfbeam
