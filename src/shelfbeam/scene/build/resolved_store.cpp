#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/resolved_types.hpp"
#include "shelfbeam/scene/fixture/fixture_writer.hpp"
#include "shelfbeam/scene/store/material_json.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

class Resolver {
 public:
  Resolver(const Store& store, const Scene& scene) : store_(store), scene_(scene) {}

  Json store() const {
    Json json;
    json["format"] = store_format_version;
    json["name"] = store_.name;
    json["wavelength_nm"] = store_.wavelength_nm;
    if (store_.room) json["room"] = room(*store_.room);
    for (const auto& [name, material, range] : store_.materials) {
      Json& written = json["materials"][name] = resolved(material);
      if (range) written["reflectance_range"] = *range;
    }
    for (const LabelType& type : store_.label_types) json["label_types"][type.name] = resolved(type);
    for (const TransceiverType& type : store_.transceiver_types)
      json["transceiver_types"][type.name] = resolved(type);
    json["fixtures"] = Json::array();
    for (const auto& [value, where] : store_.fixtures) json["fixtures"].push_back(fixture(value));
    json["labels"] = Json::array();
    for (const Label& label : scene_.labels)
      json["labels"].push_back({{"id", label.id},
                                {"position", array_of(label.position)},
                                {"normal", array_of(label.normal)},
                                {"type", scene_.type_of(label).name}});
    json["transceivers"] = {{"list", Json::array()}, {"installed", Json::array()}};
    for (const Transceiver& unit : scene_.transceivers) {
      json["transceivers"]["list"].push_back({{"id", unit.id},
                                              {"position", array_of(unit.position)},
                                              {"axis", array_of(unit.axis)},
                                              {"roll_deg", unit.roll_deg},
                                              {"type", scene_.type_of(unit).name}});
      if (unit.installed) json["transceivers"]["installed"].push_back(unit.id);
    }
    return json;
  }

 private:
  const std::string& name(MaterialId id) const { return store_.materials[id.value].name; }

  Json room(const Room& r) const {
    return {{"size", array_of(r.size)},
            {"floor", name(r.materials[4])},
            {"ceiling", name(r.materials[5])},
            {"walls",
             {{"x0", name(r.materials[0])},
              {"x1", name(r.materials[1])},
              {"y0", name(r.materials[2])},
              {"y1", name(r.materials[3])}}}};
  }

  Json fixture(const Fixture& fixture) const {
    Json json;
    FixtureWriter writer{json, store_.materials};
    write(fixture, writer);
    return json;
  }

  const Store& store_;
  const Scene& scene_;
};

}  // namespace

std::string resolved_store_json(const Store& store, const Scene& scene) {
  return Resolver(store, scene).store().dump(1) + "\n";
}

}  // namespace shelfbeam
