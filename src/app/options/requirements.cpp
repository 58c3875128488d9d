#include "app/options/requirements.hpp"

#include "shelfbeam/signal/constraints/apart.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

void Requirements::keep(const std::filesystem::path& output) const {
  for (const auto& file : costs) keep_input(output, file);
  for (const auto& file : forbidden) keep_input(output, file);
}

void Requirements::apply(SignalTable& table, const std::string& name) const {
  for (const auto& file : costs) apply_costs(table, file);
  for (const auto& file : forbidden) forbid_pairs(table, file);
  if (min_spacing > 0) keep_apart(table, min_spacing, name);
}

void add_requirement_options(CLI::App& verb, Requirements& requirements) {
  verb.add_option("--costs", requirements.costs,
                  "CSV 'id,cost' of transceivers or 'id,link_cost,signal_cost' of labels; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
  verb.add_option("--min-spacing", requirements.min_spacing,
                  "Choose no two transceivers closer than this, m (installed ones stay where they are)")
      ->check(positive_number());
  verb.add_option("--forbid", requirements.forbidden,
                  "CSV 'a,b' of transceivers that must not be chosen together; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
}

}  // namespace shelfbeam::app
