#include "serve/http/outbox.hpp"

#include <string>

#include <gtest/gtest.h>

namespace shelfbeam::serve::http {
namespace {

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
