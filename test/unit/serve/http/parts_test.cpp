// Tests the parts of the server: targets of requests, heads of replies, tokens, and the queue of messages.

#include "serve/http/asset.hpp"
#include "serve/http/outbox.hpp"
#include "serve/http/reply.hpp"
#include "serve/http/target.hpp"
#include "serve/http/token.hpp"
#include "unit/serve/testing.hpp"

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

TEST(Reply, KeepsBrowsersFromDoingMore) {
  for (const unsigned status : {200U, 304U, 400U, 403U, 404U, 405U, 413U, 431U, 500U}) {
    const std::string head = head_of(refusal(status), true);
    for (const std::string_view field :
         {"Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval';",
          "frame-ancestors 'none'", "\r\nX-Content-Type-Options: nosniff\r\n",
          "\r\nReferrer-Policy: no-referrer\r\n", "\r\nCross-Origin-Opener-Policy: same-origin\r\n",
          "\r\nCross-Origin-Resource-Policy: same-origin\r\n", "\r\nCache-Control: no-store\r\n"})
      EXPECT_THAT(head, testing::HasSubstr(field)) << status;
    for (const std::string_view field : {"'unsafe", "Server:", "Access-Control", "Set-Cookie"})
      EXPECT_THAT(head, testing::Not(testing::HasSubstr(field))) << status;
  }
  EXPECT_THAT(head_of(refusal(405), true), testing::HasSubstr("\r\nAllow: GET, HEAD\r\n"));
}

TEST(Reply, OfAnAssetIsShortIfTheCopyIsCurrent) {
  const Asset asset("text/plain", "a");
  const std::string tag = asset.reply({}).etag;
  for (const std::string& tags : {tag, "\"other\", " + tag, "W/\"other\", " + tag}) {
    const Reply reply = asset.reply({"GET", "/", {{"If-None-Match", tags}}});
    EXPECT_EQ(reply.status, 304u);
    EXPECT_FALSE(reply.body);
  }
  const Reply reply = asset.reply({"GET", "/", {{"If-None-Match", "\"other\""}}});
  EXPECT_EQ(reply.status, 200u);
  EXPECT_TRUE(reply.is_gzip);
  EXPECT_NE(Asset("text/plain", "b").reply({}).etag, tag);
}

TEST(Token, IsComparedAsAWhole) {
  EXPECT_TRUE(is_secret("secret", "secret"));
  for (const std::string_view wrong : {"", "s", "secre", "secret0", "Secret", "secreT"})
    EXPECT_FALSE(is_secret(wrong, "secret")) << wrong;
  EXPECT_FALSE(is_secret("", ""));
}

Message of_size(std::size_t size, char content = 'x') {
  return Message::text(std::string(size, content));
}

TEST(Outbox, SendsMessagesInFragments) {
  Outbox outbox(100, 4);
  ASSERT_TRUE(outbox.push(Message::text("hello you")));
  ASSERT_TRUE(outbox.push(Message::binary("")));
  ASSERT_TRUE(outbox.push(Message::binary("1234")));
  std::string sent;
  while (const auto fragment = outbox.next())
    sent += std::string(fragment->bytes) + (fragment->is_last ? "|" : "-") +
            (fragment->message.is_text ? "t " : "b ");
  EXPECT_EQ(sent, "hell-t o yo-t u|t |b 1234|b ");
}

TEST(Outbox, HoldsOneLargeMessageOrAFewSmallOnes) {
  Outbox outbox(10, 4);
  EXPECT_TRUE(outbox.push(of_size(50))) << "the first one may be large";
  EXPECT_FALSE(outbox.push(of_size(1)));
  ASSERT_TRUE(outbox.next());
  EXPECT_TRUE(outbox.push(of_size(30))) << "what is being sent does not count";
  EXPECT_FALSE(outbox.push(of_size(1)));
  while (outbox.next()) continue;
  EXPECT_TRUE(outbox.push(of_size(5)));
  EXPECT_TRUE(outbox.push(of_size(5)));
  EXPECT_FALSE(outbox.push(of_size(1)));
}

TEST(Outbox, ForgetsTheRestOfAMessage) {
  Outbox outbox(10, 4);
  ASSERT_TRUE(outbox.push(of_size(6, 'a')));
  ASSERT_TRUE(outbox.next());
  ASSERT_TRUE(outbox.push(of_size(6, 'b')));
  outbox.clear();
  EXPECT_FALSE(outbox.next());
  ASSERT_TRUE(outbox.push(of_size(2, 'c')));
  EXPECT_EQ(outbox.next()->bytes, "cc");
}

}  // namespace
}  // namespace shelfbeam::serve::http
