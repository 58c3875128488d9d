#include "shelfbeam/scene/field_writer.hpp"

namespace shelfbeam {

const std::string& FieldWriter::name_of(NameList list, std::uint32_t index) const {
  if (list == NameList::material) return lists_.materials[index].name;
  return list == NameList::label_type ? lists_.label_types[index].name : lists_.transceiver_types[index].name;
}

bool FieldWriter::references(std::string_view key, NameList list,
                             std::vector<std::pair<std::string, std::uint32_t>>& values, const Field& field) {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const auto& [name, index] : values) names[name] = name_of(list, index);
  return write(key, names, field);
}

bool FieldWriter::object(std::string_view key, const Part& part, const Field& field) {
  if (!field.is_written) return false;
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  FieldWriter writer(object, lists_);
  part(writer);
  return write(key, object, field);
}

bool FieldWriter::objects(std::string_view key, std::size_t count,
                          const std::function<void(Fields&, std::size_t)>& part, const Field& field) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; field.is_written && k < count; ++k) {
    FieldWriter writer(list.emplace_back(nlohmann::ordered_json::object()), lists_);
    part(writer, k);
  }
  return write(key, list, field);
}

}  // namespace shelfbeam
