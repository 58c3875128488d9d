#include "shelfbeam/base/provenance.hpp"

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

// Values from the reference implementation (xxhsum -H2 and -H3, version 0.8).
TEST(Provenance, HashesAreXxh3) {
  EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(content_hash("a"), "a96faf705af16834e6c632b61e964e1f");
  EXPECT_EQ(content_hash("abc"), "06b05ab6733a618578af5f94892f3950");
  EXPECT_EQ(hash64(""), 0x2d06800538d394c2u);
  EXPECT_EQ(hash64("abc"), 0x78af5f94892f3950u);
}

TEST(Provenance, HashesOfStreamsEqualThoseOfTexts) {
  for (const std::size_t size : {0, 3, 1 << 20, (5 << 19) + 1}) {
    std::string text(size, 'x');
    for (std::size_t k = 0; k < size; k += 7) text[k] = static_cast<char>(k);
    std::istringstream stream("before" + text);
    stream.seekg(6);
    EXPECT_EQ(content_hash(stream), content_hash(text)) << size;
  }
}

TEST(Provenance, HashesDependOnEveryByte) {
  std::string text(300, 'x');
  const std::string before = content_hash(text);
  for (char& c : text) {
    c = 'y';
    EXPECT_NE(content_hash(text), before);
    c = 'x';
  }
  EXPECT_EQ(content_hash(text), before);
  EXPECT_NE(content_hash(std::string("a\0", 2)), content_hash("a"));
}

TEST(Error, MessageContainsPlaceProblemAndSuggestion) {
  EXPECT_STREQ(InputError("a.json: x", "is odd", "make it even").what(), "a.json: x: is odd; make it even");
  EXPECT_STREQ(InputError("a.json", "is odd").what(), "a.json: is odd");
  EXPECT_STREQ(InputError("", "is odd").what(), "is odd");
  EXPECT_EQ(InputError("a.json: x", "is odd").where(), "a.json: x");
}

TEST(RunControl, IsOptionalThroughout) {
  const RunControl none;
  EXPECT_FALSE(none.cancelled());
  EXPECT_NO_THROW(none.report(Task::planning, 0.5));

  struct : ProgressSink {
    void report(Task task, double fraction, std::string_view detail) override {
      last = std::string(to_text(task)) + " " + std::to_string(fraction) + " " + std::string(detail);
    }
    std::string last;
  } sink;
  CancelToken token;
  const RunControl control{.cancel = &token, .progress = &sink};
  control.report(Task::annealing, 0.25, "more");
  EXPECT_EQ(sink.last, "annealing 0.250000 more");
  EXPECT_FALSE(control.cancelled());
  token.request();
  EXPECT_TRUE(control.cancelled());
}

}  // namespace
}  // namespace shelfbeam::test
