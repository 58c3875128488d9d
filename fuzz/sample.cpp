#include "sample.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <random>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::fuzz {

namespace {

class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), random_(seed) {}

  std::string next() {
    std::string bytes = seeds_[below(seeds_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes);
    return bytes;
  }

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

 private:
  void change(std::string& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(1 + below(16), bytes.size() - at);
    switch (below(8)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = "\0\x01\x7f\x80\xff \n,\"{[-"[below(12)];
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4: {
        const std::string& other = seeds_[below(seeds_.size())];
        bytes.replace(at, length, other, below(other.size()), 1 + below(64));
        break;
      }
      case 5:
        bytes.resize(at);
        break;
      case 6:
        bytes = foreign_texts(bytes)[below(3)];
        break;
      default:
        replace_number(bytes, at);
    }
  }

  // Replaces the next digits by a number that readers do not expect.
  void replace_number(std::string& bytes, std::size_t at) {
    static constexpr std::array numbers{"0",      "-1",         "1e308",      "1e999",
                                        "nan",    "4294967295", "4294967296", "18446744073709551615",
                                        "1e-320", "999999999",  "65535",      "0.5"};
    const std::size_t first = bytes.find_first_of("0123456789", at);
    if (first == std::string::npos) return;
    const std::size_t last = std::min(bytes.find_first_not_of("0123456789.", first), bytes.size());
    bytes.replace(first, last - first, numbers[below(numbers.size())]);
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};

// Whether the input is read (not refused). Other outcomes are written to `finding`.
bool is_read(const Reader& reader, const std::string& bytes, std::string& finding) {
  try {
    reader.read(bytes);
    return true;
  } catch (const InputError&) {
  } catch (const std::exception& error) {
    finding = error.what();
  } catch (...) {
    finding = "an exception other than std::exception";
  }
  return false;
}

}  // namespace

Sample sample(const Reader& reader, std::size_t changed, std::uint64_t seed, double longest_s) {
  const std::vector<std::string> seeds = reader.seeds();
  Mutator mutator(seeds, seed);
  Sample result;
  while (result.inputs < seeds.size() + changed) {
    std::string bytes = result.inputs < seeds.size() ? seeds[result.inputs] : mutator.next();
    if (result.inputs >= seeds.size() && reader.repair != nullptr && mutator.below(8) != 0)
      reader.repair(bytes);
    ++result.inputs;
    const auto begin = std::chrono::steady_clock::now();
    if (is_read(reader, bytes, result.finding)) ++result.read;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (result.finding.empty() && taken.count() > longest_s)
      result.finding = "takes " + std::to_string(taken.count()) + " s";
    if (!result.finding.empty()) {
      result.input = std::move(bytes);
      return result;
    }
  }
  return result;
}

}  // namespace shelfbeam::fuzz
