#include "shelfbeam/signal/tables/formats.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_npy_table(std::string_view bytes) {
  detail::read_npy_table(scratch().write("matrix.npy", bytes));
}

template <class T>
std::string npy(std::string_view type, std::string_view order, std::string_view shape,
                const std::vector<T>& values, char version = 1) {
  std::string header = "{'descr': '";
  header.append(type).append("', 'fortran_order': ").append(order);
  header.append(", 'shape': ").append(shape).append(", }\n");
  std::string file = "\x93NUMPY";
  file += version;
  file += '\0';
  for (int k = 0; k < (version == 1 ? 2 : 4); ++k) file += static_cast<char>(header.size() >> (8 * k) & 0xff);
  return file + header + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string with_header(std::string_view header, const std::string& data) {
  return std::string("\x93NUMPY\1\0", 8) + static_cast<char>(header.size()) + '\0' + std::string(header) +
         data;
}

std::vector<std::string> npy_table_seeds() {
  const std::string data(24, '\0');
  return {npy<float>("<f4", "False", "(2, 3)", {1, 0, 2, 3, 4, 5}),
          npy<double>("<f8", "True", "(2, 3)", {1, 0, 2, 3, 4, 5}, 2),
          npy<float>("<f4", "False", "(1, 1)", {1}),
          with_header(R"({"shape": (2, 3), "fortran_order": False, "descr": "<f4"})", data),
          with_header("{u'descr': u'=f4', u'fortran_order': True, u'shape': (2L, 3L), } \n", data)};
}

}  // namespace

extern const Reader npy_table;
const Reader npy_table{"npy_table", fuzz_npy_table, npy_table_seeds};

}  // namespace shelfbeam::fuzz
