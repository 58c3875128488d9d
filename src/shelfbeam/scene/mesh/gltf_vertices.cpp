#include "shelfbeam/scene/mesh/gltf_vertices.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr const char* export_again = "export the file again";

void expect_count(std::size_t count, std::size_t vertices, const JsonCursor& place) {
  if (count != vertices)
    place.fail(fmt::format("has {} elements for {} vertices", count, vertices), export_again);
}

void morph(std::vector<Vec3>& vertices, GltfFile& file, const JsonCursor& targets,
           const std::vector<double>& weights) {
  const std::vector<JsonCursor> list = targets.elements();
  if (!weights.empty() && weights.size() != list.size())
    targets.fail(fmt::format("has {} morph targets for {} weights", list.size(), weights.size()),
                 export_again);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const auto accessor = list[k].find("POSITION");
    if (weights[k] == 0 || !accessor) continue;
    const std::vector<Vec3> shifts = file.positions(*accessor);
    expect_count(shifts.size(), vertices.size(), *accessor);
    for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = vertices[v] + weights[k] * shifts[v];
  }
}

// Each vertex moves as the weighted mean of its joints.
void skin(std::vector<Vec3>& vertices, GltfFile& file, const JsonCursor& attributes,
          const std::vector<GltfPlacement>& joints) {
  std::vector<Vec3> moved(vertices.size());
  std::vector<double> sums(vertices.size());
  std::optional<JsonCursor> names = attributes["JOINTS_0"];
  for (int set = 0; names; names = attributes.find(fmt::format("JOINTS_{}", ++set))) {
    const std::vector<double> numbers = file.numbers(*names, "VEC4");
    const JsonCursor place = attributes[fmt::format("WEIGHTS_{}", set)];
    const std::vector<double> weights = file.numbers(place, "VEC4");
    expect_count(numbers.size() / 4, vertices.size(), *names);
    expect_count(weights.size() / 4, vertices.size(), place);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (weights[k] == 0) continue;
      if (!(numbers[k] >= 0 && numbers[k] < static_cast<double>(joints.size())) ||
          numbers[k] != std::floor(numbers[k]))
        names->fail(fmt::format("names joint {} of {}, counted from 0", numbers[k], joints.size()),
                    export_again);
      const GltfPlacement& joint = joints[static_cast<std::size_t>(numbers[k])];
      moved[k / 4] = moved[k / 4] + weights[k] * joint.point(vertices[k / 4]);
      sums[k / 4] += weights[k];
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!(sums[v] > 0))
      attributes["WEIGHTS_0"].fail(fmt::format("has no weight at vertex {}", v), export_again);
    vertices[v] = moved[v] / sums[v];
  }
}

}  // namespace

std::vector<double> morph_weights(const JsonCursor& node, const JsonCursor& mesh) {
  for (const JsonCursor* owner : {&node, &mesh})
    if (const auto weights = owner->find("weights")) return weights->numbers();
  return {};
}

std::vector<Vec3> gltf_vertices(GltfFile& file, const JsonCursor& primitive,
                                const std::vector<double>& weights,
                                const std::vector<GltfPlacement>& joints) {
  const JsonCursor attributes = primitive["attributes"];
  std::vector<Vec3> vertices = file.positions(attributes["POSITION"]);
  if (const auto targets = primitive.find("targets")) morph(vertices, file, *targets, weights);
  if (!joints.empty()) skin(vertices, file, attributes, joints);
  return vertices;
}

}  // namespace shelfbeam
