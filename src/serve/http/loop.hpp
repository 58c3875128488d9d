#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <memory>

namespace boost::asio {
class io_context;
}

namespace shelfbeam::serve::http {

/// Calls functions when something happens, all on the thread in `run`. Only `post` may be called from other
/// threads.
class Loop {
 public:
  Loop();
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// For those that wait for bytes themselves.
  boost::asio::io_context& context();

  /// Calls `ready` whenever a descriptor can be read, until it returns a time, after which it is called
  /// again. The descriptor must outlive the loop.
  void when_readable(int descriptor, std::function<std::chrono::milliseconds()> ready);
  /// Calls `action` at this interval.
  void every(std::chrono::milliseconds interval, std::function<void()> action);
  /// Calls `action` soon, after the caller has returned.
  void post(std::function<void()> action);

  /// Runs until `stop`. Exceptions of the functions go to `failed`.
  void run(const std::function<void(std::exception_ptr)>& failed);
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shelfbeam::serve::http
