#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/fixture_geometry.hpp"
#include "shelfbeam/scene/build/resolved_types.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json array(const Vec3& v) {
  return {v.x, v.y, v.z};
}

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
    for (const auto& [value, where] : store_.fixtures)
      json["fixtures"].push_back(std::visit([this](const auto& f) { return fixture(f); }, value));
    json["labels"] = Json::array();
    for (const Label& label : scene_.labels)
      json["labels"].push_back({{"id", label.id},
                                {"position", array(label.position)},
                                {"normal", array(label.normal)},
                                {"type", scene_.type_of(label).name}});
    json["transceivers"] = {{"list", Json::array()}, {"installed", Json::array()}};
    for (const Transceiver& unit : scene_.transceivers) {
      json["transceivers"]["list"].push_back({{"id", unit.id},
                                              {"position", array(unit.position)},
                                              {"axis", array(unit.axis)},
                                              {"roll_deg", unit.roll_deg},
                                              {"type", scene_.type_of(unit).name}});
      if (unit.installed) json["transceivers"]["installed"].push_back(unit.id);
    }
    return json;
  }

 private:
  const std::string& name(MaterialId id) const { return store_.materials[id.value].name; }

  Json room(const Room& r) const {
    return {{"size", array(r.size)},
            {"floor", name(r.materials[4])},
            {"ceiling", name(r.materials[5])},
            {"walls",
             {{"x0", name(r.materials[0])},
              {"x1", name(r.materials[1])},
              {"y0", name(r.materials[2])},
              {"y1", name(r.materials[3])}}}};
  }

  Json shelving(const char* type, const Shelving& s) const {
    Json json{{"type", type},
              {"id", s.id},
              {"at", s.at},
              {"rotation_deg", s.rotation_deg},
              {"length", s.length},
              {"depth", s.depth},
              {"height", s.height},
              {"material", name(s.material)},
              {"goods", name(s.goods)},
              {"stocking", s.stocking}};
    if (s.doors) json["doors"] = name(*s.doors);
    return json;
  }
  Json fixture(const Gondola& g) const {
    Json json = shelving("gondola", g);
    json["shelves"] = g.shelves;
    json["faces"] = Json::array();
    for (const Face face : g.faces) json["faces"].push_back(face_name(face));
    return json;
  }
  Json fixture(const Freezer& f) const { return shelving("freezer", f); }
  Json fixture(const Box& b) const {
    return {{"type", "box"},
            {"id", b.id},
            {"min", array(b.min)},
            {"max", array(b.max)},
            {"material", name(b.material)}};
  }
  Json fixture(const MeshFixture& m) const {
    Json json{{"type", "mesh"},    {"id", m.id},
              {"at", array(m.at)}, {"rotation_deg", m.rotation_deg},
              {"scale", m.scale},  {"parts", Json::array()}};
    for (const MeshPiece& piece : m.pieces) {
      Json part{{"name", piece.name},
                {"material", name(piece.material)},
                {"vertices", Json::array()},
                {"faces", piece.triangles}};
      for (const Vec3& vertex : piece.vertices) part["vertices"].push_back(array(vertex));
      json["parts"].push_back(std::move(part));
    }
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
