#include "serve/http/server.hpp"

#include <fcntl.h>

#include "unit/serve/http/test_server.hpp"

namespace shelfbeam::test {
namespace {

using testing::HasSubstr;

TEST(Server, SendsAFileOfThePage) {
  const RunningServer server;
  const std::string answer = server.ask(server.request("page.txt"));
  EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nContent-Type: text/plain\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nCache-Control: no-cache\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nContent-Encoding: gzip\r\n"));
  EXPECT_THAT(answer, testing::EndsWith("\r\n\r\nthe page"));
  const std::size_t tag = answer.find("ETag: ") + 6;
  const std::string etag = answer.substr(tag, answer.find("\r\n", tag) - tag);
  EXPECT_THAT(server.ask(server.request("page.txt", "If-None-Match: " + etag + "\r\n")),
              testing::StartsWith("HTTP/1.1 304 "));
  EXPECT_THAT(server.ask(server.request("")), testing::EndsWith("<!doctype html>"));
}

std::set<int> open_descriptors() {
  std::set<int> open;
  for (int number = 0; number < 256; ++number)
    if (::fcntl(number, F_GETFD) >= 0) open.insert(number);
  return open;
}

// The browser that the server's program starts must not hold the port.
TEST(Server, PassesNoDescriptorsOn) {
  const std::set<int> before = open_descriptors();
  const RunningServer server;
  const Client page = server.tab();
  for (const int number : open_descriptors()) {
    if (before.contains(number)) continue;
    EXPECT_NE(::fcntl(number, F_GETFD) & FD_CLOEXEC, 0)
        << std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", number));
  }
}

TEST(Server, SendsADocumentThatIsNotKept) {
  const RunningServer server;
  const std::string answer = server.ask(server.request("made"));
  EXPECT_THAT(answer, HasSubstr("\r\nCache-Control: no-store\r\n"));
  EXPECT_THAT(answer, testing::EndsWith("\r\n\r\n{}"));
  EXPECT_THAT(server.ask(server.request("other")), testing::StartsWith("HTTP/1.1 404 "));
}

TEST(Server, TakesFilesInPieces) {
  const RunningServer server;
  Client client(server.port());
  const std::string content(100'000, 'x');
  for (int i = 0; i < 2; ++i) {
    const std::string head = server.request(
        "files/plan.png",
        fmt::format("Origin: http://{}\r\nContent-Length: {}\r\n", server.host(), content.size()), "PUT");
    const std::string all = head + content;
    for (std::size_t at = 0; at < all.size(); at += 33'333)
      client.send(std::string_view(all).substr(at, 33'333));
    const std::string answer = client.answer();
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 201 Created\r\n"));
    EXPECT_THAT(answer, testing::EndsWith("\r\n\r\n100000 bytes of files/plan.png"));
  }
  client.send(server.request("page.txt"));
  EXPECT_THAT(client.answer(), testing::EndsWith("the page"));
  const std::string refused = server.ask(
      server.request("files/bad.png",
                     fmt::format("Origin: http://{}\r\nContent-Length: 3\r\n", server.host()), "PUT") +
      "abc");
  EXPECT_THAT(refused, testing::StartsWith("HTTP/1.1 422 Unprocessable Content\r\n"));
  EXPECT_THAT(refused, testing::EndsWith("\r\n\r\nno picture"));
}

TEST(Server, AnswersSeveralRequestsOnOneConnection) {
  const RunningServer server;
  Client client(server.port());
  for (int i = 0; i < 3; ++i) {
    client.send(server.request("page.txt", {}, "HEAD"));
    EXPECT_THAT(client.answer(false), HasSubstr("\r\nContent-Length: 8\r\n"));
    client.send(server.request("page.txt"));
    EXPECT_THAT(client.answer(), testing::EndsWith("the page"));
  }
  client.send(server.request("page.txt", "Connection: close\r\n"));
  EXPECT_THAT(client.rest(), testing::EndsWith("the page"));
}

TEST(Server, TalksToPages) {
  RunningServer server;
  {
    Client first = server.tab(), second = server.tab();
    EXPECT_TRUE(becomes_true([&] { return server.opened == 2; }));
    for (Client* page : {&first, &second}) {
      page->send(Frame{.payload = "hello"});
      EXPECT_EQ(page->message(), "hello");
    }
    for (const std::size_t size : {std::size_t{20'000}, std::size_t{5'000'000}}) {
      first.send(Frame{.payload = "size " + std::to_string(size)});
      EXPECT_EQ(first.message()->size(), size);
    }
    second.send(Frame{.opcode = Opcode::close, .payload = "\x03\xe8"});
    EXPECT_EQ(second.close_code(), 1000u);
    EXPECT_EQ(second.rest(), "");
    EXPECT_TRUE(server.answers(first));
  }
  EXPECT_TRUE(becomes_true([&] { return server.closed == 2; }));
  EXPECT_EQ(server.failed, 0);
}

TEST(Server, SurvivesExceptionsOfItsOwner) {
  RunningServer server;
  Client first = server.tab(), second = server.tab();
  first.send(Frame{.payload = "throw"});
  EXPECT_EQ(first.close_code(), 1011u);
  const std::string answer = server.ask(server.request("throw"));
  EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 500 "));
  EXPECT_THAT(answer, testing::Not(HasSubstr("detail")));
  EXPECT_TRUE(server.answers(second));
  EXPECT_EQ(server.failed, 2);
  EXPECT_TRUE(becomes_true([&] { return server.ticks > 5; }));
}

TEST(Server, StopsInSpiteOfAPageThatDoesNotReply) {
  RunningServer server({.farewell = milliseconds(50)});
  const Client page = server.tab();
  EXPECT_TRUE(becomes_true([&] { return server.opened == 1; }));
  server.stop();
  EXPECT_EQ(server.closed, 1);
}

TEST(Server, HasAnAddressThatNobodyGuesses) {
  const serve::http::Server one({}, {}), two({}, {});
  EXPECT_EQ(one.token().size(), 32u);
  EXPECT_NE(one.token(), two.token());
  expect_input_error([] { const serve::http::Server short_one({.token = "short"}, {}); }, "token");
  EXPECT_THAT(one.addresses(),
              testing::ElementsAre(fmt::format("http://127.0.0.1:{}/{}/", one.port(), one.token())));
}

TEST(Server, TellsAUserWhoComesByAnotherName) {
  const RunningServer server;
  EXPECT_THAT(server.ask("GET / HTTP/1.1\r\nHost: shop.example\r\n\r\n"),
              testing::EndsWith(
                  "403 Forbidden: this host name is not allowed; allow it when you start the program\n"));
  EXPECT_THAT(server.ask(server.request("page.txt", "Origin: http://shop.example\r\n")),
              testing::EndsWith("403 Forbidden\n"));
}

}  // namespace
}  // namespace shelfbeam::test
