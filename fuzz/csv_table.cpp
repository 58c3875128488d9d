#include "shelfbeam/base/error.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

#include "reader.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_csv_table(std::string_view bytes) {
  for (const TableReading reading :
       {TableReading::signals, TableReading::header, TableReading::labels, TableReading::ids}) {
    try {
      detail::read_csv_table(bytes, "matrix.csv", reading);
    } catch (const InputError&) {  // refused in this reading only
    }
  }
  const SignalTable table = detail::read_csv_table(bytes, "matrix.csv").table;
  detail::check_unique_ids(table, "matrix.csv");
}

std::vector<std::string> csv_table_seeds() {
  return {"0.1,0.2,0\n0,1e-3,4\n",
          "label,T1,T2\nA,0.1,0.2\n\"B, \"\"2\"\"\",0,1e-3\n",
          "T1,T2\r\nA,0.1,0.2\r\n",
          "1\n2\n\n3\n",
          "sep=;\r\nlabel;T1;T,2\r\nA;0,5;0,25\r\n",
          "label;T1;\"T;2\"\nA;0,5;1,125\n",
          "label\tT1\rA\t0,5\r'=B\t1\r",
          "T1,T2,\n3,0,\n4,5,\n",
          "4.00638E+12,0.5\n4.00639E+12,0.25\n",
          "0,1,2\n0.5,0.25,0\n0,0.125,0.75\n",
          "EAN;4,00638E+12;#N/A\n=\"1\";0,5;0,2\n123.0;1;0\n"};
}

}  // namespace

extern const Reader csv_table;
const Reader csv_table{"csv_table", fuzz_csv_table, csv_table_seeds};

}  // namespace shelfbeam::fuzz
