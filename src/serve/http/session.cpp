#include "serve/http/session.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <fmt/format.h>
#include <sys/socket.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/files/open_file.hpp"

#include "serve/http/outbox.hpp"

namespace shelfbeam::serve::http {
namespace net = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;

namespace {

// TCP, or a local stream socket in tests.
using Stream = net::basic_stream_socket<net::generic::stream_protocol, net::io_context::executor_type>;
// Without compression: a few bytes of a client cannot become many here.
using WebSocket = websocket::stream<Stream, false>;
using Parser = beast::http::request_parser<beast::http::empty_body>;

constexpr std::size_t fragment = 256 << 10, kept_buffer = 64 << 10, most_drained = 1 << 20;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

Stream stream_on(net::io_context& context, Descriptor connection) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  ::getsockname(connection.number(), reinterpret_cast<sockaddr*>(&address), &size);
  Stream stream(context, {address.ss_family, 0}, connection.number());
  connection.release();  // the stream closes it now
  return stream;
}

class SocketSession final : public Session, public std::enable_shared_from_this<SocketSession> {
  // A handler that keeps this session alive. Nothing happens after the end, and an exception is the end.
  template <class Action>
  auto after(Action action) {
    return [self = shared_from_this(), action](error_code error, std::size_t size = 0) {
      if (self->is_over_) return;
      try {
        if constexpr (std::is_invocable_v<Action, error_code, std::size_t>) {
          action(error, size);
        } else {
          action(error);
        }
      } catch (...) {
        self->abort();
        throw;
      }
    };
  }

 public:
  SocketSession(net::io_context& context, Descriptor connection, TabId id, SessionHost& host)
      : id_(id), host_(host), limits_(host.limits()), stream_(stream_on(context, std::move(connection))) {}

  void start() override { read_head(); }

  Standing standing() const override {
    if (is_open_) return Standing::open;
    if (!has_token_) return Standing::stranger;
    return is_waiting_ ? Standing::waiting : Standing::answered;
  }

  Clock::time_point deadline() const override { return deadline_; }

  std::uint64_t upload() const override { return file_size_; }

  void send(Message message) override {
    if (!is_open_ || is_closing_ || is_over_) return;
    if (!outbox_.push(std::move(message))) {
      close(CloseCode::try_again_later);
    } else if (!is_writing_) {
      write_fragment();
    }
  }

  void close(CloseCode code) override {
    if (!is_open_) return abort();
    if (is_closing_ || is_over_) return;
    is_closing_ = true;
    outbox_.clear();
    allow(limits_.farewell);
    socket_->async_close({static_cast<std::uint16_t>(code)}, after([this](error_code) { abort(); }));
  }

  void abort() override {
    if (is_over_) return;
    is_over_ = true;
    error_code ignored;
    (socket_ ? socket_->next_layer() : stream_).close(ignored);
    host_.ended(id_, is_open_);
  }

 private:
  void allow(Limits::Time time) { deadline_ = Clock::now() + time; }

  void read_head() {
    is_waiting_ = false;
    allow(limits_.head_time);
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(limits_.head));
    // The gate refuses bodies but those of files, which `read_file` reads.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    beast::http::async_read_header(stream_, buffer_, *parser_,
                                   after([this](error_code error) { on_head(error); }));
  }

  void on_head(error_code error) {
    using Problem = beast::http::error;
    if (error == Problem::header_limit || error == Problem::buffer_overflow)
      return answer(refusal(431), false);
    const bool has_ended = error == Problem::end_of_stream || error == Problem::partial_message;
    if (error.category() == make_error_code(Problem::bad_target).category() && !has_ended)
      return answer(refusal(400), false);
    if (error) return abort();

    const auto& head = parser_->get();
    Request request{view(head.method_string()), view(head.target()), {}};
    for (const auto& field : head)
      request.fields.emplace_back(view(field.name_string()), view(field.value()));
    const Verdict verdict = host_.judge(request);
    has_token_ = has_token_ || verdict.has_token;
    if (verdict.refusal != 0) {
      answer(refusal(verdict.refusal, verdict.why), false);
    } else if (verdict.is_socket) {
      open_socket();
    } else if (verdict.upload > 0) {
      if (const auto refused = host_.spool(verdict.upload, file_)) return answer(*refused, false);
      file_name_ = verdict.name;
      file_size_ = verdict.upload;
      received_ = 0;
      read_file();
    } else {
      answer(host_.reply(request, verdict), parser_->get().keep_alive());
    }
  }

  // Takes bytes that have come, and waits for the rest.
  void read_file() {
    const std::size_t size = std::min<std::uint64_t>(file_size_ - received_, buffer_.size());
    const auto bytes = buffer_.cdata();
    if (!write_at(file_.number(), {static_cast<const char*>(bytes.data()), size}, received_))
      return end_file(refusal(422, fmt::format("the file cannot be kept ({})", system_reason())), false);
    received_ += size;
    buffer_.consume(size);
    if (received_ == file_size_)
      return end_file(host_.receive(file_name_, file_, file_size_), parser_->get().keep_alive());
    allow(limits_.write);
    const std::size_t next = std::min<std::uint64_t>(file_size_ - received_, limits_.head);
    stream_.async_read_some(buffer_.prepare(next), after([this](error_code error, std::size_t read) {
                              buffer_.commit(read);
                              error ? abort() : read_file();
                            }));
  }

  void end_file(const Reply& reply, bool keep_alive) {
    file_ = Descriptor();
    file_size_ = 0;
    answer(reply, keep_alive);
  }

  void answer(const Reply& reply, bool keep_alive) {
    keep_alive_ = keep_alive;
    head_ = head_of(reply, keep_alive);
    body_ = parser_->get().method() == beast::http::verb::head ? nullptr : reply.body;
    sent_ = 0;
    write_some();
  }

  void write_some() {
    const std::string_view body = body_ ? std::string_view(*body_) : std::string_view{};
    const std::size_t of_head = std::min(sent_, head_.size());
    const std::string_view rest = body.substr(sent_ - of_head);
    if (of_head == head_.size() && rest.empty()) return on_answered();
    allow(limits_.write);
    const std::array<net::const_buffer, 2> buffers{net::buffer(head_) + of_head,
                                                   net::buffer(rest.data(), rest.size())};
    stream_.async_write_some(buffers, after([this](error_code error, std::size_t size) {
                               sent_ += size;
                               error ? abort() : write_some();
                             }));
  }

  void on_answered() {
    body_.reset();
    if (!keep_alive_) {
      error_code ignored;
      stream_.shutdown(Stream::shutdown_send, ignored);
      allow(limits_.farewell);
      return drain(0);
    }
    if (buffer_.size() > 0) return read_head();
    is_waiting_ = true;
    allow(limits_.idle);
    stream_.async_wait(Stream::wait_read, after([this](error_code error) { error ? abort() : read_head(); }));
  }

  // To close a socket with unread bytes would take the answer away from the client. A page that sends a file
  // which is refused may use the whole time.
  void drain(std::size_t drained) {
    const bool is_file = has_token_ && parser_->get().method() == beast::http::verb::put;
    if (drained > most_drained && !is_file) return abort();
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(limits_.head),
                            after([this, drained](error_code error, std::size_t size) {
                              error ? abort() : drain(drained + size);
                            }));
  }

  void open_socket() {
    // A browser sends nothing before it knows that the socket is open.
    if (buffer_.size() > 0) return answer(refusal(400), false);
    socket_.emplace(std::move(stream_));
    socket_->set_option(websocket::stream_base::timeout{limits_.farewell, limits_.silence, true});
    socket_->set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      for (const auto& [name, value] : security_fields())
        response.set(beast::string_view(name.data(), name.size()),
                     beast::string_view(value.data(), value.size()));
      response.set(beast::http::field::cache_control, "no-store");
      response.set(beast::http::field::server, "");  // else Beast tells its version
    }));
    socket_->read_message_max(limits_.message);
    socket_->auto_fragment(false);
    allow(limits_.write);
    socket_->async_accept(parser_->get(), after([this](error_code error) { error ? abort() : on_open(); }));
  }

  void on_open() {
    parser_.reset();
    is_open_ = true;
    deadline_ = Clock::time_point::max();
    read_on(host_.opened(id_));
  }

  void read_on(bool is_well) {
    if (is_closing_ || is_over_) return;
    if (!is_well) return close(CloseCode::internal_error);
    socket_->async_read(messages_, after([this](error_code error) { on_message(error); }));
  }

  void on_message(error_code error) {
    if (is_closing_) return;  // `close` waits for the end
    if (error) return abort();
    if (!socket_->got_text()) return close(CloseCode::unknown_data);
    const auto bytes = messages_.cdata();
    const bool is_well = host_.text(id_, {static_cast<const char*>(bytes.data()), bytes.size()});
    messages_.consume(messages_.size());
    if (messages_.capacity() > kept_buffer) messages_.shrink_to_fit();
    read_on(is_well);
  }

  void write_fragment() {
    const std::optional<Outbox::Fragment> next = outbox_.next();
    is_writing_ = next.has_value();
    deadline_ = Clock::time_point::max();
    if (!next) return;
    allow(limits_.write);
    socket_->text(next->message.is_text);
    socket_->async_write_some(next->is_last, net::buffer(next->bytes.data(), next->bytes.size()),
                              after([this, kept = next->message.bytes](error_code error, std::size_t) {
                                if (is_closing_) return;
                                error ? abort() : write_fragment();
                              }));
  }

  const TabId id_;
  SessionHost& host_;
  const Limits limits_;
  Clock::time_point deadline_{};
  bool has_token_ = false, is_waiting_ = false, is_over_ = false;

  Stream stream_;
  beast::flat_buffer buffer_{limits_.head + 1024};
  std::optional<Parser> parser_;
  std::string head_;
  Bytes body_;
  std::size_t sent_ = 0;  // of head and body together
  bool keep_alive_ = false;
  std::string file_name_;  // that is being received
  Descriptor file_;
  std::uint64_t file_size_ = 0, received_ = 0;

  std::optional<WebSocket> socket_;  // has taken the stream
  beast::flat_buffer messages_{limits_.message + 1024};
  Outbox outbox_{limits_.queue, fragment};
  bool is_open_ = false, is_closing_ = false, is_writing_ = false;
};

}  // namespace

std::shared_ptr<Session> make_session(net::io_context& context, Descriptor connection, TabId id,
                                      SessionHost& host) {
  return std::make_shared<SocketSession>(context, std::move(connection), id, host);
}

}  // namespace shelfbeam::serve::http
