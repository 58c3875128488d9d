// consumer STORE: simulates a store with few samples, places transceivers, prints what came out.

#include <cstdio>
#include <exception>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

int main(int argc, char** argv) {
  using namespace shelfbeam;
  if (argc != 2) return 2;
  try {
    const Scene scene = make_scene(read_store(argv[1]));
    SimulationOptions options;
    options.samples = 256;
    const SignalTable table = make_signal_table(simulate(scene, "", options).matrix);
    const Placement placement = place(table, {}, {});
    std::printf("%zu labels, %zu candidates: %zu transceivers, at least %.0f\n", table.rows(),
                table.columns(), placement.count(), placement.count_lower_bound);
    return placement.has_selection() ? 0 : 1;
  } catch (const InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
