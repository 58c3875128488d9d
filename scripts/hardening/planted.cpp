// One error for each sanitizer, with which scripts/hardening/sanitize checks that the sanitizers work.
#include <climits>
#include <cstring>
#include <thread>
#include <vector>

namespace {

void overflow_heap(int count) {
  std::vector<char> text(static_cast<std::size_t>(count));
  text.data()[count] = 'x';
}

int overflow_number(int count) {
  return INT_MAX - 1 + count;
}

void lose_memory(int count) {
  std::vector<char>* volatile lost = nullptr;
  for (int k = 0; k < 100; ++k) lost = new std::vector<char>(static_cast<std::size_t>(count + k));
  lost = nullptr;
}

void race(int count) {
  std::thread other([&] { ++count; });
  ++count;
  other.join();
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return 0;
  if (std::strcmp(words[1], "heap") == 0) overflow_heap(count);
  if (std::strcmp(words[1], "number") == 0) return overflow_number(count) == 0;
  if (std::strcmp(words[1], "leak") == 0) lose_memory(count);
  if (std::strcmp(words[1], "race") == 0) race(count);
  return 0;
}
