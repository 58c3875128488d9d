#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace shelfbeam::app {

/// An example store; its files are those of the folder of the same name in examples/.
struct Template {
  std::string_view name, description;
};

inline constexpr std::array<Template, 6> store_templates{
    {{"thesis", "the test environment of the paper: 390 labels, 320 candidates"},
     {"grocery", "a small grocery with gondolas, freezers and checkouts"},
     {"chiller", "a petrol station shop with glass doors and aimed units"},
     {"market-hall", "an L-shaped hall: zones, inner walls, presets, a planogram"},
     {"supermarket", "50 x 40 m: 5,000 labels, 600 candidates"},
     {"hypermarket", "110 x 85 m: 40,000 labels, 2,000 candidates"}}};

/// Writes the files of a template to a folder, which is created. Throws InputError for an unknown name, and
/// if one of the files exists; OutputError.
const Template& write_template(const std::string& name, const std::filesystem::path& folder);

}  // namespace shelfbeam::app
