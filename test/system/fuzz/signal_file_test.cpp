#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

#include "hdf5_checksums.hpp"
#include "reader.hpp"

namespace shelfbeam::fuzz {
namespace {

// The HDF5 library follows addresses of metadata whose checksums are right wherever they lead, some of them
// into nothing (found by fuzzing).
TEST(SlowHostileSignalFile, AddressesThatLeadNowhere) {
  const Reader& reader = *find_reader("signal_file");
  const std::string good = reader.seeds().front();
  const std::string address("\xF0\xFF\xFF\xFF\xFF\xFF\xFF\x7F", 8);
  std::size_t refused = 0;
  for (std::size_t at = 12; at < 3000; at += 4) {
    std::string bytes = good;
    bytes.replace(at, address.size(), address);
    repair_hdf5_checksums(bytes);
    try {
      reader.read(bytes);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST(SlowHostileSignalFile, RightChecksumsAreNotChanged) {
  const std::string good = find_reader("signal_file")->seeds().front();
  std::string bytes = good;
  repair_hdf5_checksums(bytes);
  EXPECT_EQ(bytes, good);
}

}  // namespace
}  // namespace shelfbeam::fuzz
