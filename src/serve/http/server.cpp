#include "serve/http/server.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/http/gate.hpp"
#include "serve/http/listener.hpp"
#include "serve/http/loop.hpp"
#include "serve/http/session.hpp"
#include "serve/http/token.hpp"

namespace shelfbeam::serve::http {

namespace {

using Milliseconds = std::chrono::milliseconds;

Options checked(Options options) {
  if (options.token.empty()) options.token = make_token();
  const std::string known = "-_0123456789abcdefghijklmnopqrstuvwxyz";
  if (options.token.size() < 16 || lower_case(options.token).find_first_not_of(known) != std::string::npos)
    throw InputError("the token", "is not 16 or more letters, digits, '-' and '_'");
  return options;
}

// How often deadlines are checked.
Milliseconds interval(const Limits& limits) {
  const Milliseconds shortest = std::min({limits.head_time, limits.idle, limits.write, limits.farewell});
  return std::clamp(shortest / 4, Milliseconds(1), Milliseconds(1000));
}

// The bytes of a file, which need no memory.
class Mapping {
 public:
  Mapping(const Descriptor& file, std::uint64_t size)
      : size_(size), start_(::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0)) {
    if (start_ == MAP_FAILED) throw OutputError("the file", "cannot be kept (" + system_reason() + ")");
  }
  ~Mapping() { ::munmap(start_, size_); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(start_), size_}; }

 private:
  std::size_t size_;
  void* start_;
};

}  // namespace

struct Server::State final : SessionHost {
  State(Options options_, Handlers handlers_, bool listens)
      : options(checked(std::move(options_))), handlers(std::move(handlers_)), hosts{options.address} {
    if (listens) {
      listener.emplace(options.address, options.port);
      loop.when_readable(listener->descriptor(), [this] { return accept(); });
      options.port = listener->port();
      hosts = listener->hosts();
    }
    gate.emplace(hosts, options.port, options.token, options.hosts, options.limits.upload);
    loop.every(interval(options.limits), [this] { end_late_sessions(); });
    if (options.tick.count() > 0)
      loop.every(options.tick, [this] { attempt([this] { call(handlers.tick); }); });
  }

  void run() {
    loop.run([this](const std::exception_ptr& error) { report(error); });
  }

  const Limits& limits() const override { return options.limits; }

  Verdict judge(const Request& request) override { return gate->judge(request); }

  Reply reply(const Request& request, const Verdict& verdict) override {
    Reply reply = refusal(500);
    attempt([&] {
      if (const auto asset = options.assets.find(verdict.name); asset != options.assets.end()) {
        reply = asset->second.reply(request);
        return;
      }
      const std::optional<Document> found = handlers.get ? handlers.get(verdict.name) : std::nullopt;
      reply = found ? Reply{.type = found->type, .body = found->bytes, .is_report = found->is_report}
                    : refusal(404);
    });
    return reply;
  }

  std::optional<Reply> spool(std::uint64_t size, Descriptor& file) override {
    if (!handlers.put || !handlers.spool) return refusal(405);
    for (const auto& [id, session] : sessions) size += session->upload();
    if (size > options.limits.upload)
      return refusal(413, fmt::format("files of more than {} MiB in total would arrive at a time; try again "
                                      "when the others have arrived",
                                      options.limits.upload >> 20));
    try {
      file = handlers.spool();
      return {};
    } catch (const std::exception& error) {
      return refusal(422, error.what());
    }
  }

  Reply receive(const std::string& name, const Descriptor& file, std::uint64_t size) override {
    Reply reply = refusal(500);
    attempt([&] {
      const Mapping content(file, size);
      const Receipt receipt = handlers.put(name, content.bytes());
      reply = {.status = receipt.is_kept ? 201U : 422U,
               .type = receipt.is_kept ? "application/json" : "text/plain; charset=utf-8",
               .body = std::make_shared<const std::string>(receipt.text)};
    });
    return reply;
  }

  bool opened(TabId id) override {
    return attempt([&] { call(handlers.opened, id); });
  }

  bool text(TabId id, std::string_view message) override {
    return attempt([&] { call(handlers.text, id, message); });
  }

  // The handler is called later, because the owner of the server may be in a loop over its pages that sends
  // to each.
  void ended(TabId id, bool was_open) override {
    sessions.erase(id);
    loop.post([this, id, was_open] {
      if (was_open) attempt([&] { call(handlers.closed, id); });
      stop_if_done();
    });
  }

  void adopt(Descriptor connection) {
    const auto session = make_session(loop.context(), std::move(connection), ++last_id, *this);
    sessions.emplace(last_id, session);
    session->start();
  }

  // Returns how long to wait before the next call.
  Milliseconds accept() {
    if (is_ending) return std::chrono::hours(1);
    // A few at a time, so that a crowd at the door does not delay those inside.
    for (int i = 0; i < 16; ++i) {
      Descriptor connection;
      const Listener::Accepted accepted = listener->accept(connection);
      if (accepted == Listener::Accepted::failed) return Milliseconds(100);
      if (accepted == Listener::Accepted::none) break;
      if (make_room()) adopt(std::move(connection));
    }
    return Milliseconds(0);
  }

  // Ends the oldest session that is not in use, if there are too many.
  bool make_room() {
    if (sessions.size() < options.limits.connections) return true;
    for (const Standing standing : {Standing::stranger, Standing::waiting}) {
      for (const auto& [id, session] : sessions) {
        if (session->standing() != standing) continue;
        std::shared_ptr(session)->abort();
        return true;
      }
    }
    return false;
  }

  void end_late_sessions() {
    const auto now = Session::Clock::now();
    for (const auto& session : present())
      if (session->deadline() < now) session->abort();
  }

  void say_farewell() {
    is_ending = true;
    for (const auto& session : present()) session->close(CloseCode::going_away);
    stop_if_done();
  }

  void stop_if_done() {
    if (is_ending && sessions.empty()) loop.stop();
  }

  // A copy, because sessions that end leave the table.
  std::vector<std::shared_ptr<Session>> present() const {
    std::vector<std::shared_ptr<Session>> all;
    for (const auto& [id, session] : sessions) all.push_back(session);
    return all;
  }

  template <class Function, class... Arguments>
  static void call(const Function& function, const Arguments&... arguments) {
    if (function) function(arguments...);
  }

  // Whether the action succeeds.
  template <class Action>
  bool attempt(const Action& action) {
    try {
      action();
      return true;
    } catch (...) {
      report(std::current_exception());
      return false;
    }
  }

  void report(const std::exception_ptr& error) const {
    std::string what = "an unknown exception";
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& known) {
      what = known.what();
    } catch (...) {  // keeps the text above
    }
    try {
      call(handlers.failed, what);
    } catch (...) {  // there is nobody left to tell
    }
  }

  Options options;
  Handlers handlers;
  std::vector<std::string> hosts;
  std::optional<Listener> listener;
  std::optional<Gate> gate;
  Loop loop;
  std::map<TabId, std::shared_ptr<Session>> sessions;  // the oldest first
  TabId last_id = 0;
  bool is_ending = false;
};

Server::Server(Options options, Handlers handlers)
    : state_(std::make_unique<State>(std::move(options), std::move(handlers), true)) {}

Server::Server(Options options, Handlers handlers, Descriptor connection)
    : state_(std::make_unique<State>(std::move(options), std::move(handlers), false)) {
  state_->adopt(std::move(connection));
  state_->is_ending = true;
}

Server::~Server() = default;

std::uint16_t Server::port() const {
  return state_->options.port;
}

const std::string& Server::token() const {
  return state_->options.token;
}

std::vector<std::string> Server::addresses() const {
  std::vector<std::string> all;
  for (const std::string& host : state_->hosts)
    all.push_back(fmt::format("http://{}:{}/{}/", host, port(), token()));
  return all;
}

void Server::run() {
  state_->run();
}

void Server::stop() {
  state_->loop.post([state = state_.get()] { state->say_farewell(); });
}

void Server::send(TabId tab, Message message) {
  if (const auto found = state_->sessions.find(tab); found != state_->sessions.end())
    std::shared_ptr(found->second)->send(std::move(message));
}

}  // namespace shelfbeam::serve::http
