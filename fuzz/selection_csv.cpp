#include "shelfbeam/signal/constraints/conflicts.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"

namespace shelfbeam::fuzz {

namespace {

// Reads tables of weights, of costs or of conflicts, which differ in their headers.
void fuzz_selection_csv(std::string_view bytes) {
  static const SignalTable unchanged = small_table();
  SignalTable table = unchanged;
  const std::filesystem::path file = scratch().write("selection.csv", bytes);
  if (bytes.starts_with("id,w"))
    apply_weights(table, file);
  else if (bytes.starts_with("id"))
    apply_costs(table, file);
  else
    forbid_pairs(table, file);
}

std::vector<std::string> selection_csv_seeds() {
  return {"id,cost\nT0,2\nT3,0.5\n", "id,link_cost,signal_cost\nL0,1,2\nL2,0,1e-3\n", "a,b\nT0,T1\nT2,T3\n",
          "id,weight\nL0,2\nL2,0.5\n"};
}

}  // namespace

extern const Reader selection_csv;
const Reader selection_csv{"selection_csv", fuzz_selection_csv, selection_csv_seeds};

}  // namespace shelfbeam::fuzz
