#include "shelfbeam/report/messages/light.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::vector<std::string> light_texts(const Words& words, const std::vector<LightKind>& kinds,
                                     const Scene& scene) {
  std::vector<std::string> texts;
  for (const LightKind& light : kinds) {
    std::vector<std::string> names;
    for (const MaterialId material : light.materials) names.push_back(scene.materials[material.value].name);
    texts.push_back(words.say(fmt::format("light.way.{}", to_text(light.way)),
                              words(fmt::format("light.end.{}", to_text(light.end))),
                              fmt::format("{}", fmt::join(names, ", ")), light.mirrors));
  }
  return texts;
}

}  // namespace shelfbeam
