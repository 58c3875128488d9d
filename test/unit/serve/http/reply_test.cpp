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
         {"Content-Security-Policy: default-src 'none'; script-src 'self';", "frame-ancestors 'none'",
          "\r\nX-Content-Type-Options: nosniff\r\n", "\r\nReferrer-Policy: no-referrer\r\n",
          "\r\nCross-Origin-Opener-Policy: same-origin\r\n",
          "\r\nCross-Origin-Resource-Policy: same-origin\r\n", "\r\nCache-Control: no-store\r\n"})
      EXPECT_THAT(head, testing::HasSubstr(field)) << status;
    for (const std::string_view field : {"unsafe", "Server:", "Access-Control", "Set-Cookie"})
      EXPECT_THAT(head, testing::Not(testing::HasSubstr(field))) << status;
  }
  EXPECT_THAT(head_of(refusal(405), true), testing::HasSubstr("\r\nAllow: GET, HEAD\r\n"));
}

TEST(Reply, OfAnAssetIsInflatedOnlyForThoseWhoWantIt) {
  const std::string content(300'000, 'a');
  const Asset asset = Asset::compressed("text/plain", content);
  const auto accepting = [&](std::string_view encodings) {
    return asset.reply({"GET", "/", {{"accept-encoding", encodings}}});
  };
  for (const std::string_view encodings :
       {"gzip", "br, GZIP", "gzip;q=0.5, *;q=0", "deflate;q=0,gzip ; q=1.0"}) {
    EXPECT_TRUE(accepting(encodings).is_gzip) << encodings;
    EXPECT_LT(accepting(encodings).body->size(), 1000u);
  }
  for (const std::string_view encodings : {"", "identity", "br", "gzip;q=0", "gzip; q=0.00", "xgzip"}) {
    EXPECT_FALSE(accepting(encodings).is_gzip) << encodings;
    EXPECT_EQ(*accepting(encodings).body, content);
  }
  const std::string tag = asset.reply({}).etag;
  for (const std::string& tags : {tag, "\"other\", " + tag}) {
    const Reply reply = asset.reply({"GET", "/", {{"If-None-Match", tags}}});
    EXPECT_EQ(reply.status, 304u);
    EXPECT_FALSE(reply.body);
  }
  EXPECT_EQ(asset.reply({"GET", "/", {{"If-None-Match", "\"other\""}}}).status, 200u);
  EXPECT_NE(Asset::compressed("text/plain", "b").reply({}).etag, tag);
}

TEST(Reply, OfADamagedAssetIsAnError) {
  const Reply packed =
      Asset::compressed("text/plain", "some content").reply({"GET", "/", {{"accept-encoding", "gzip"}}});
  for (const std::string& damaged :
       {std::string(), std::string("text"), packed.body->substr(0, packed.body->size() - 4)})
    EXPECT_THROW(Asset("text/plain", damaged).reply({}), std::runtime_error);
}

TEST(Token, IsComparedAsAWhole) {
  EXPECT_TRUE(is_secret("secret", "secret"));
  for (const std::string_view wrong : {"", "s", "secre", "secret0", "Secret", "secreT"})
    EXPECT_FALSE(is_secret(wrong, "secret")) << wrong;
  EXPECT_FALSE(is_secret("", ""));
}

}  // namespace
}  // namespace shelfbeam::serve::http
