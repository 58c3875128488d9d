// Many connections.

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "support/processor_time.hpp"
#include "unit/serve/http/attacked_server.hpp"

namespace shelfbeam::test {
namespace {

class Crowd : public AttackedServer {
 protected:
  using AttackedServer::AttackedServer;
};

TEST_F(Crowd, OfStrangersGivesWayToTheOwner) {
  std::vector<Client> strangers;
  for (int i = 0; i < 200; ++i) {
    strangers.emplace_back(server.port());
    if (i % 50 == 49) {
      EXPECT_TRUE(server.answers(page)) << i;
    }
  }
  EXPECT_EQ(strangers.front().rest(), "") << "the oldest is dropped";
}

TEST_F(Crowd, OfPagesIsLimited) {
  std::vector<Client> pages;
  for (int i = 1; i < 64; ++i) pages.push_back(server.tab());
  Client one_more(server.port());
  one_more.send(server.request("page.txt"));
  EXPECT_EQ(one_more.rest(), "");
  for (Client& other : pages) {
    other.send(Frame{.payload = "hello"});
    EXPECT_EQ(other.message(), "hello");
  }
  pages.pop_back();
}

TEST_F(Crowd, OfIdleConnectionsGivesWay) {
  std::vector<Client> idle;
  for (int i = 0; i < 200; ++i) {
    idle.emplace_back(server.port()).send(server.request("page.txt"));
    EXPECT_THAT(idle.back().answer(), testing::EndsWith("the page"));
  }
}

TEST_F(Crowd, OfStrangersLeavesIdleConnectionsOfTheOwner) {
  Client idle(server.port());
  idle.send(server.request("page.txt"));
  EXPECT_THAT(idle.answer(), testing::EndsWith("the page"));
  std::vector<Client> strangers;
  strangers.reserve(100);
  for (int i = 0; i < 100; ++i) strangers.emplace_back(server.port());
  EXPECT_TRUE(server.answers(page));
  idle.send(server.request("page.txt"));
  EXPECT_THAT(idle.answer(), testing::EndsWith("the page"));
}

// The files of this process up to its limit.
class UsedUpDescriptors {
 public:
  explicit UsedUpDescriptors(rlim_t limit) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit low{std::min(limit, before_.rlim_cur), before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &low);
    for (int file = 0; (file = ::open("/dev/null", O_RDONLY)) >= 0;) files_.push_back(file);
  }
  ~UsedUpDescriptors() {
    while (!files_.empty()) free_one();
    ::setrlimit(RLIMIT_NOFILE, &before_);
  }
  UsedUpDescriptors(const UsedUpDescriptors&) = delete;
  UsedUpDescriptors& operator=(const UsedUpDescriptors&) = delete;

  void free_one() {
    ::close(files_.back());
    files_.pop_back();
  }

 private:
  rlimit before_{};
  std::vector<int> files_;
};

TEST_F(Crowd, WithoutDescriptorsWaits) {
  std::optional<UsedUpDescriptors> full(std::in_place, 200);
  full->free_one();
  Client client(server.port());  // takes the last one
  client.send(server.request("page.txt"));
  const ProcessorTime time;
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  page.send(Frame{.payload = "hello"});
  EXPECT_EQ(page.message(), "hello");
  EXPECT_LT(time.seconds(), 0.05 * slowness) << "the server spins";
  full.reset();
  EXPECT_THAT(client.answer(), testing::EndsWith("the page"));
}

class SlowCrowd : public Crowd {
 protected:
  SlowCrowd() {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    before_ = limit.rlim_cur;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 4096);
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
  ~SlowCrowd() override {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = before_;
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }

 private:
  rlim_t before_ = 0;
};

TEST_F(SlowCrowd, OfTenThousandOneByOneLeavesNoTrace) {
  for (int i = 0; i < 10'000; ++i) {
    const Client client(server.port());
    if (i % 3 > 0)
      client.send(i % 3 == 1 ? "GET / HTTP" : "GET / HTTP/1.1\r\nHost: attacker.example\r\n\r\n");
    if (i % 1000 == 0) {
      EXPECT_TRUE(server.answers(page)) << i;
    }
  }
}

TEST_F(SlowCrowd, OfAThousandAtOnceKeepsTheOwner) {
  std::vector<Client> crowd;
  for (int i = 0; i < 1000; ++i) crowd.emplace_back(server.port()).send("GET / HTTP/1.1\r\nHost: ");
  for (int round = 0; round < 10; ++round) {
    for (const Client& client : crowd) client.send("x");
    EXPECT_TRUE(server.answers(page)) << round;
  }
}

TEST_F(SlowCrowd, OfPagesThatDoNotReadIsBounded) {
  // Each has a message on its way and a queue that is almost full.
  std::vector<Client> crowd;
  for (int i = 0; i < 20; ++i) {
    crowd.push_back(server.tab(4096));
    for (int k = 0; k < 9; ++k) crowd.back().send(Frame{.payload = "size 1000000"});
  }
  EXPECT_TRUE(server.answers(page));
}

}  // namespace
}  // namespace shelfbeam::test
