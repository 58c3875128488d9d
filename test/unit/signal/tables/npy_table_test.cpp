#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

template <class T>
std::string bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string npy(const std::string& header, const std::string& data, char version = 1) {
  std::string file = "\x93NUMPY";
  file += version;
  file += '\0';
  const std::size_t length = header.size();
  for (int k = 0; k < (version == 1 ? 2 : 4); ++k) file += static_cast<char>(length >> (8 * k) & 0xff);
  return file + header + data;
}

std::string header(const std::string& type, const std::string& order, const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
}

SignalTable read(const std::string& content) {
  const TempFolder folder;
  return read_signal_table(folder.write("matrix.npy", content));
}

void expect_two_by_three(const SignalTable& table) {
  ASSERT_EQ(table.rows(), 2u);
  ASSERT_EQ(table.columns(), 3u);
  ASSERT_EQ(table.entries.size(), 5u) << "the one zero is no entry";
  EXPECT_EQ(table.labels[1].id, "L2");
  EXPECT_EQ(table.transceivers[2].id, "T3");
  EXPECT_EQ(table.row(0)[0].signal, 1);
  EXPECT_EQ(table.row(0)[1].signal, 3);
  EXPECT_EQ(table.row(0)[1].transceiver, 2u);
  EXPECT_EQ(table.row(1)[1].signal, 5);
}

TEST(NpyTable, ReadsBothTypesOrdersAndVersions) {
  const std::vector<float> rows = {1, 0, 3, 4, 5, 6}, columns = {1, 4, 0, 5, 3, 6};
  const std::vector<double> wide(rows.begin(), rows.end()), wide_columns(columns.begin(), columns.end());
  expect_two_by_three(read(npy(header("<f4", "False", "(2, 3)"), bytes(rows))));
  expect_two_by_three(read(npy(header("<f8", "False", "(2, 3)"), bytes(wide))));
  expect_two_by_three(read(npy(header("<f4", "True", "(2, 3)"), bytes(columns))));
  expect_two_by_three(read(npy(header("<f8", "True", "(2,3)"), bytes(wide_columns), 2)));
}

TEST(NpyTable, HeadersAreAnyPythonDictionary) {
  const std::string data = bytes(std::vector<float>{1, 0, 3, 4, 5, 6});
  for (const char* dialect : {"{'shape': (2, 3), 'descr': '<f4', 'fortran_order': False}",
                              R"({"descr": "<f4", "fortran_order": False, "shape": (2, 3)})",
                              "{u'descr': u'<f4', u'fortran_order': False, u'shape': (2L, 3L), }  \n",
                              "{'descr':'<f4','fortran_order':False,'shape':[2,3,]}",
                              "  {\n'descr' : '<f4' ,\n'fortran_order' : False ,\n'shape' : ( 2 , 3 )\n}\n",
                              "{'descr': '=f4', 'fortran_order': False, 'shape': (2, 3), }\n",
                              "{'descr': 'float32', 'fortran_order': False, 'shape': (2, 3), }\n"})
    expect_two_by_three(read(npy(dialect, data)));
}

TEST(NpyTable, OtherHeadersAreRefused) {
  const std::string data = bytes(std::vector<float>{1, 0, 3, 4, 5, 6});
  const auto refused = [&](const std::string& text, std::string_view problem) {
    expect_input_error([&] { read(npy(text, data)); }, "matrix.npy: header: ", problem);
  };
  refused("", "dictionary");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3)", "dictionary");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3}", "dictionary");
  refused("{'descr': '<f4, 'fortran_order': False, 'shape': (2, 3)}", "dictionary");
  refused("{'descr': '<f4', 'descr': '<f8', 'fortran_order': False, 'shape': (2, 3)}", "'<f8'");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), 'color': 1}", "'color': 1");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': 6}", "shape is 6");
  refused("{'descr': '<f4', 'fortran_order': False, 'shape': (2.0, 3)}", "shape is (2.0, 3)");
  refused("{'descr': [('a', '<f4'), ('b', '<f4')], 'fortran_order': False, 'shape': (3,)}",
          "[('a', '<f4'), ('b'");
  refused("{'descr': '>f4', 'fortran_order': False, 'shape': (2, 3)}", "big-endian");
}

TEST(NpyTable, BrokenFilesAreRefused) {
  const std::vector<float> data = {1, 0, 3, 4, 5, 6};
  const auto refused = [](const std::string& content, std::string_view problem) {
    expect_input_error([&] { read(content); }, "matrix.npy", problem);
  };
  refused(npy(header("<i4", "False", "(2, 3)"), bytes(data)), "'<i4'");
  refused(npy(header("<f4", "Maybe", "(2, 3)"), bytes(data)), "fortran_order");
  for (const char* shape : {"(6,)", "()", "(1, 2, 3)", "(0, 3)", "(2, -3)", "(2, 5000000000)"})
    refused(npy(header("<f4", "False", shape), bytes(data)), shape);
  refused(npy(header("<f4", "False", "(2, 3)"), bytes(data) + "x"), "25 bytes");
  refused(npy(header("<f4", "False", "(4294967294, 4294967294)"), bytes(data)), "24 bytes");
  refused(npy(header("<f8", "False", "(2147483648, 4294967294)"), bytes(data)), "24 bytes");
  refused(npy("{'descr': '<f4', }\n", bytes(data)), "'fortran_order'");
  refused(npy(header("<f4", "False", "(2, 3)"), bytes(data), 9), ": header: ");
  refused(std::string("\x93NUMPY\x01\0\xff\xff", 10), ": header: ");
  const std::string whole = npy(header("<f4", "False", "(2, 3)"), bytes(data));
  for (std::size_t length = 0; length < whole.size(); ++length)
    input_error([&] { read(whole.substr(0, length)); });
}

TEST(NpyTable, BadEntriesAreNamed) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto refused = [](std::vector<float> data, const char* order, std::string_view problem) {
    expect_input_error([&] { read(npy(header("<f4", order, "(2, 3)"), bytes(data))); }, "row 2, column 1",
                       problem);
  };
  refused({1, 0, 3, std::nanf(""), 5, 6}, "False", "NaN");
  refused({1, 0, 3, infinite, 5, 6}, "False", "infinite");
  refused({1, 0, 3, -1, 5, 6}, "False", "negative");
  refused({1, -1, 3, 4, 5, 6}, "True", "negative");
}

}  // namespace
}  // namespace shelfbeam::test
