#include "shelfbeam/signal/measured/measurements.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_measurements(std::string_view bytes) {
  static const SignalMatrix matrix = small_matrix();
  read_measurements(scratch().write("measured.csv", bytes), matrix);
}

std::vector<std::string> measurements_seeds() {
  return {"label,transceiver,signal,error\nL0,T1,0.1,0.01\nL2,T3,-0.2,1e-3\n",
          "sep=;\nlabel;signal\nL1;3,5\n", "label,signal\nL1,3\n\"L2\",4\n"};
}

}  // namespace

extern const Reader measurements;
const Reader measurements{"measurements", fuzz_measurements, measurements_seeds};

}  // namespace shelfbeam::fuzz
