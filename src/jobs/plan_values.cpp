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

std::optional<std::string> store_of_plan(const fs::path& folder) {
  const fs::path file = folder / run_name;
  if (!is_run_file(file)) return {};
  const auto named = JsonCursor::parse_file(file).find("store");
  return named && named->is_string() ? std::optional(named->text()) : std::nullopt;
}

bool renew_values(StoredPlan& stored, const Scene& now, bool is_old) {
  const auto in = [](const std::vector<DecisiveValue>& values, const DecisiveValue& value) {
    const auto found = std::ranges::find_if(values, [&](const auto& other) { return other.is(value); });
    return found == values.end() ? nullptr : &*found;
  };
  const bool has_none = stored.plan.values.empty();
  std::vector<DecisiveValue> values = has_none ? stored.scene.values : stored.plan.values;
  bool differs = false;
  for (DecisiveValue& value : values) {
    if (has_none) value.state = ValueState::given;
    const DecisiveValue *planned = in(stored.scene.values, value), *present = in(now.values, value);
    if (planned == nullptr || present == nullptr || !same_value(planned->value, present->value)) continue;
    const ValueState state = is_old ? std::max(present->state, ValueState::given) : present->state;
    differs = differs || value.state != state;
    value.state = state;
  }
  if (differs) stored.plan.values = std::move(values);
  const bool is_example = now.source == ValueSource::example;
  return std::exchange(stored.plan.is_example, is_example) != is_example || differs;
}

}  // namespace shelfbeam::jobs
