#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/files/descriptor.hpp"

#include "serve/http/asset.hpp"
#include "serve/http/message.hpp"

namespace shelfbeam::serve::http {

/// What a client may use. The times are checked at intervals of a quarter of the
/// shortest one, and of at most a second.
struct Limits {
  using Time = std::chrono::milliseconds;
  std::size_t connections = 64;
  std::size_t head = 8 << 10;                 ///< bytes of the head of a request
  Time head_time = std::chrono::seconds(10);  ///< from its first to its last byte
  Time idle = std::chrono::seconds(30);       ///< between two requests
  Time write = std::chrono::seconds(20);      ///< without progress; messages go in pieces of 256 KiB
  Time silence = std::chrono::seconds(120);   ///< of a page, which is sent a ping after half of it
  Time farewell = std::chrono::seconds(2);    ///< in which a client takes the end of a connection
  std::size_t message = 1 << 20;              ///< bytes of a message of a page, in all fragments together
  std::uint64_t upload = 64 << 20;            ///< bytes of the files that pages bring at a time
  std::size_t queue = 8 << 20;                ///< bytes that wait for a page (`Outbox`)
};

struct Options {
  /// IPv4 or IPv6. All but 127.0.0.1 and ::1 can be reached from other computers.
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: any free one
  std::string token = {};  ///< 16 or more letters, digits, "-" and "_"; empty: the server makes one
  std::vector<std::string> hosts = {};                    ///< further names of the server (`Gate`)
  std::map<std::string, Asset, std::less<>> assets = {};  ///< by their names below the token; "" is the page
  std::chrono::milliseconds tick{0};                      ///< interval of `Handlers::tick`; 0: never
  Limits limits = {};
};

/// A page that is connected through its WebSocket. Numbers grow and are never used again.
using TabId = std::uint64_t;

/// A document that is made when it is asked for. The browser does not keep it.
struct Document {
  std::string type;  ///< media type
  Bytes bytes;
  bool is_report = false;  ///< a page with scripts inside, which may reach nothing else
};

/// The answer to a file that a page brings.
struct Receipt {
  bool is_kept = false;
  std::string text;  ///< JSON if it is kept, otherwise the reason as a sentence for the user
};

/// What the owner of a server does. The thread in `Server::run` calls all of them, never from within another
/// call of the server. An exception ends neither the server nor other pages: the page of `opened` and `text`
/// is closed with code 1011, the request of `get` or `put` is answered with status 500, and `failed` is told.
/// Functions may be empty.
struct Handlers {
  std::function<void(TabId)> opened = {};
  std::function<void(TabId, std::string_view)> text = {};  ///< a message in UTF-8, gone after the call
  std::function<void(TabId)> closed = {};                  ///< once for each opened one
  /// A GET or HEAD of a name below the token that is no asset; nothing: there is none.
  std::function<std::optional<Document>(std::string_view name)> get = {};
  /// Opens an empty file for the bytes of a PUT, which is gone when it is closed (`open_unnamed`). Throws
  /// OutputError.
  std::function<Descriptor()> spool = {};
  /// A PUT of a name below the token that begins with `file_names`. The content is that of the file.
  std::function<Receipt(std::string_view name, std::string_view content)> put = {};
  std::function<void()> tick = {};
  std::function<void(std::string_view what)> failed = {};  ///< what(), for the log
};

}  // namespace shelfbeam::serve::http
