#include "jobs/plan_values.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

#include "jobs/plan_folder.hpp"
#include "jobs/run_file.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

std::string store_from(const fs::path& folder, const fs::path& store) {
  std::error_code unknown;
  return fs::exists(store, unknown) ? fs::relative(store, folder, unknown).string() : "";
}

std::optional<fs::path> store_of_plan(const fs::path& folder) {
  const fs::path file = folder / run_name;
  if (!is_run_file(file)) return {};
  const auto named = JsonCursor::parse_file(file).find("store");
  std::error_code unknown;
  if (!named || !named->is_string() || !fs::is_regular_file(folder / named->text(), unknown)) return {};
  return folder / named->text();
}

bool renew_values(StoredPlan& stored, const Scene& now) {
  const auto in = [](const std::vector<DecisiveValue>& values, const DecisiveValue& value) {
    const auto found = std::ranges::find_if(values, [&](const auto& other) { return other.is(value); });
    return found == values.end() ? nullptr : &*found;
  };
  const bool is_old = stored.plan.values.empty();
  std::vector<DecisiveValue> values = is_old ? stored.scene.values : stored.plan.values;
  bool differs = false, any_confirmed = false;
  for (DecisiveValue& value : values) {
    if (is_old) value.state = ValueState::given;
    const DecisiveValue *planned = in(stored.scene.values, value), *present = in(now.values, value);
    if (planned == nullptr || present == nullptr || !same_value(planned->value, present->value)) continue;
    const bool is_confirmed = present->state == ValueState::confirmed;
    any_confirmed = any_confirmed || is_confirmed;
    if (value.state == present->state || (is_old && !is_confirmed)) continue;
    value.state = present->state;
    differs = true;
  }
  if (is_old && !any_confirmed) return false;
  stored.plan.values = std::move(values);
  return differs;
}

}  // namespace shelfbeam::jobs
