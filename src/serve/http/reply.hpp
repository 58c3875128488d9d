#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "serve/http/message.hpp"

namespace shelfbeam::serve::http {

/// The answer to a request.
struct Reply {
  unsigned status = 200;
  std::string type = {};  ///< media type of the body
  Bytes body = {};        ///< may be empty
  bool is_gzip = false;   ///< the body is in gzip format
  std::string etag =
      {};  ///< of a fixed file, which the browser keeps and asks for again; otherwise nothing is kept
  bool is_report = false;  ///< Document::is_report
};

/// A short text for a status and perhaps a reason, without details that would help an attacker.
Reply refusal(unsigned status, std::string_view why = {});

/// The fields of every answer, also of the one that opens the WebSocket: the page runs only its own files,
/// sits in no frame, and passes its address, which contains the token, to nobody. A report runs the scripts
/// in it, but has no origin, so that it cannot send requests to the server.
std::span<const std::pair<std::string_view, std::string_view>> security_fields(bool is_report = false);

/// Status line and fields of an answer, with the empty line that ends them.
std::string head_of(const Reply& reply, bool keep_alive);

}  // namespace shelfbeam::serve::http
