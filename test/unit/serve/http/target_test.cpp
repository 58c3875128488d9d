#include "serve/http/target.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace shelfbeam::serve::http {
namespace {

TEST(Target, HasATokenAndAName) {
  const struct {
    std::string_view text, token, name;
  } all[] = {{"/T/", "T", ""},
             {"/T/page.css", "T", "page.css"},
             {"/T/results/12", "T", "results/12"},
             {"/T/%70age%2Ecss", "T", "page.css"},
             {"/T/a%20b", "T", "a b"},
             {"//page", "", "page"},
             {"/T/...", "T", "..."}};
  for (const auto& [text, token, name] : all) {
    const auto target = parse_target(text);
    ASSERT_TRUE(target) << text;
    EXPECT_EQ(target->token, token);
    EXPECT_EQ(target->name, name);
  }
}

TEST(Target, IsNothingThatNoLinkContains) {
  using namespace std::literals;
  for (const std::string_view text : {""sv,
                                      "*"sv,
                                      "/"sv,
                                      "/T"sv,
                                      "T/page"sv,
                                      "http://127.0.0.1/T/page"sv,
                                      "/T/page?x=1"sv,
                                      "/T/page#x"sv,
                                      "/T//page"sv,
                                      "/T/a//b"sv,
                                      "/T/a/"sv,
                                      "/T/../T/page"sv,
                                      "/T/./page"sv,
                                      "/T/a/.."sv,
                                      "/T/%2e%2e/page"sv,
                                      "/T/%2E./page"sv,
                                      "/T/%252e%252e/page"sv,
                                      "/T/..%2fpage"sv,
                                      "/T/a%2Fb"sv,
                                      "/T/a\\b"sv,
                                      "/T/a%5cb"sv,
                                      "/T/page%00"sv,
                                      "/T/page\0"sv,
                                      "/T/page%0d%0a"sv,
                                      "/T/page\x7f"sv,
                                      "/T/p\xc3\xa4ge"sv,
                                      "/T/p%c3%a4ge"sv,
                                      "/T/%c0%ae%c0%ae/page"sv,
                                      "/T/page%"sv,
                                      "/T/page%4"sv,
                                      "/T/page%4g"sv,
                                      "/T/page%+1"sv})
    EXPECT_FALSE(parse_target(text)) << text;
}

}  // namespace
}  // namespace shelfbeam::serve::http
