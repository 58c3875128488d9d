// Counts the rays of a program that links the Embree library dynamically. Preloaded, it stands before the
// library's functions and writes the number of their rays to the file that SHELFBEAM_RAY_FILE names, so that
// programs without a count of their own can be compared.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>

namespace {

// Threads share few counters, each on a cache line of its own.
struct alignas(64) Counter {
  std::atomic<std::uint64_t> rays{0};
};
std::array<Counter, 64> counters;
std::atomic<std::size_t> threads{0};

void count(std::uint64_t rays) {
  thread_local Counter& own = counters[threads.fetch_add(1) % counters.size()];
  own.rays.fetch_add(rays, std::memory_order_relaxed);
}

// Versions 3 and 4 differ in the order of their arguments, which are pointers in both.
using OfThree = void (*)(void*, void*, void*);
using OfFour = void (*)(const int*, void*, void*, void*);

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

struct Writer {
  ~Writer() {
    const char* path = std::getenv("SHELFBEAM_RAY_FILE");
    std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "w");
    if (file == nullptr) return;
    std::uint64_t sum = 0;
    for (const Counter& counter : counters) sum += counter.rays;
    std::fprintf(file, "%llu\n", static_cast<unsigned long long>(sum));
    std::fclose(file);
  }
} writer;

}  // namespace

extern "C" {

void rtcIntersect1(void* a, void* b, void* c) {
  static const auto original = next<OfThree>("rtcIntersect1");
  count(1);
  original(a, b, c);
}

void rtcOccluded1(void* a, void* b, void* c) {
  static const auto original = next<OfThree>("rtcOccluded1");
  count(1);
  original(a, b, c);
}

void rtcOccluded16(const int* valid, void* b, void* c, void* d) {
  static const auto original = next<OfFour>("rtcOccluded16");
  std::uint64_t rays = 0;
  for (int k = 0; k < 16; ++k) rays += valid[k] != 0 ? 1 : 0;
  count(rays);
  original(valid, b, c, d);
}
}
