#include "serve/http/loop.hpp"

#include <list>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

namespace shelfbeam::serve::http {
namespace net = boost::asio;
using boost::system::error_code;

namespace {

struct Watch {
  Watch(net::io_context& context, int descriptor) : watched(context, descriptor), pause(context) {}
  ~Watch() { watched.release(); }  // Asio would close it
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void arm(std::chrono::milliseconds wait) {
    if (wait.count() == 0) {
      watched.async_wait(net::posix::stream_descriptor::wait_read, [this](error_code error) { call(error); });
      return;
    }
    pause.expires_after(wait);
    pause.async_wait([this](error_code error) {
      if (!error) arm({});
    });
  }

  void call(error_code error) {
    if (error == net::error::operation_aborted) return;
    std::chrono::milliseconds wait{100};
    std::exception_ptr problem;
    try {
      wait = ready();
    } catch (...) {
      problem = std::current_exception();
    }
    arm(wait);
    if (problem) std::rethrow_exception(problem);
  }

  net::posix::stream_descriptor watched;
  net::steady_timer pause;
  std::function<std::chrono::milliseconds()> ready;
};

struct Clockwork {
  explicit Clockwork(net::io_context& context) : timer(context) {}

  void arm() {
    timer.expires_after(interval);
    timer.async_wait([this](error_code error) {
      if (error) return;
      arm();
      action();
    });
  }

  net::steady_timer timer;
  std::chrono::milliseconds interval{};
  std::function<void()> action;
};

}  // namespace

struct Loop::State {
  net::io_context context{1};  // one thread
  std::list<Watch> watches;
  std::list<Clockwork> clocks;
};

Loop::Loop() : state_(std::make_unique<State>()) {}

Loop::~Loop() = default;

net::io_context& Loop::context() {
  return state_->context;
}

void Loop::when_readable(int descriptor, std::function<std::chrono::milliseconds()> ready) {
  Watch& watch = state_->watches.emplace_back(state_->context, descriptor);
  watch.ready = std::move(ready);
  watch.arm({});
}

void Loop::every(std::chrono::milliseconds interval, std::function<void()> action) {
  Clockwork& clock = state_->clocks.emplace_back(state_->context);
  clock.interval = interval;
  clock.action = std::move(action);
  clock.arm();
}

void Loop::post(std::function<void()> action) {
  net::post(state_->context, std::move(action));
}

void Loop::run(const std::function<void(std::exception_ptr)>& failed) {
  while (!state_->context.stopped()) {
    try {
      state_->context.run();
    } catch (...) {
      failed(std::current_exception());
    }
  }
}

void Loop::stop() {
  state_->context.stop();
}

}  // namespace shelfbeam::serve::http
