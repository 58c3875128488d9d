#include "serve/http/reply.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/http/asset.hpp"
#include "serve/http/token.hpp"

namespace shelfbeam::serve::http {
namespace {

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

}  // namespace
}  // namespace shelfbeam::serve::http
