#pragma once

#include <span>
#include <string>
#include <string_view>

namespace shelfbeam {

struct TemplateFile {
  std::string_view name;
  std::string_view content;
};

/// A store to start from; its files are those of the folder of the same name in examples/.
struct StoreTemplate {
  std::string_view name;
  std::string_view description;
  std::span<const TemplateFile> files;
};

std::span<const StoreTemplate> store_templates();

/// Throws InputError with the nearest name.
const StoreTemplate& find_template(const std::string& name);

}  // namespace shelfbeam
