#pragma once

#include <fstream>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sanitizers.hpp"
#include "unit/serve/http/running_server.hpp"

namespace shelfbeam::test {

/// A server with an open page, which must still be answered after the attack of the test. Server and attacker
/// together, which are this process, may not grow by 300 MB.
class AttackedServer : public testing::Test {
 protected:
  AttackedServer() : AttackedServer(serve::http::Limits{}) {}
  explicit AttackedServer(const serve::http::Limits& limits) : server(limits), page(server.tab()) {
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
  }

  void TearDown() override {
    EXPECT_TRUE(server.answers(page)) << "after the attack";
    EXPECT_EQ(server.failed, 0);
    const long growth = peak_memory() - memory_before_;
    RecordProperty("kilobytes", static_cast<int>(growth));
    if (memory_can_be_limited) {
      EXPECT_LT(growth, 300 << 10) << "kB";
    }
  }

  /// Sends a request, and expects that it is refused and its connection closed.
  void expect_refused(const std::string& bytes, const std::string& status) const {
    Client client(server.port());
    client.send(bytes);
    const std::string answer = client.rest();
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 " + status + " ")) << bytes.substr(0, 300);
    EXPECT_THAT(answer, testing::HasSubstr("\r\nConnection: close\r\n"));
    EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << "one answer only";
  }

  /// Expects that the same bytes are answered: without that, a refusal would prove nothing.
  void expect_let_in(const std::string& bytes, const std::string& status = "200") const {
    EXPECT_THAT(server.ask(bytes), testing::StartsWith("HTTP/1.1 " + status + " ")) << bytes;
  }

  /// Largest memory of this process since the attack began, in kB.
  static long peak_memory() { return memory("VmHWM:"); }

 private:
  static long memory(std::string_view name) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
      if (word == name && file >> word) return std::stol(word);
    return 0;
  }

  long memory_before_ = memory("VmRSS:");

 protected:
  RunningServer server;
  Client page;
};

}  // namespace shelfbeam::test
