#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "serve/http/request.hpp"

namespace shelfbeam::serve::http {

/// The name of the WebSocket below the token.
inline constexpr std::string_view socket_name = "socket";
/// Names below the token that begin with this are files, which pages may bring.
inline constexpr std::string_view file_names = "files/";

/// What the gate says of a request.
struct Verdict {
  unsigned refusal = 0;      ///< status of the answer that refuses it (403, 404, 405, ...); 0: let in
  std::string why = {};      ///< for the user, if it may be no attack
  bool has_token = false;    ///< it has shown host and token, whether or not it is let in
  bool is_socket = false;    ///< it opens the WebSocket
  std::string name = {};     ///< what it asks for or brings, below the token
  std::uint64_t upload = 0;  ///< bytes of the file that it brings; 0: none
};

/// Decides by its head who may talk to the server. Any website that the user visits can send requests to a
/// local server, and after DNS rebinding they come with the attacker's name as Host and as Origin: therefore
/// each is compared with a fixed list, never with the other.
class Gate {
 public:
  /// `own` and `port`: the addresses of the server as browsers write them, besides 127.0.0.1 and localhost.
  /// Only names can be made to point elsewhere. `names`: further hosts by which browsers reach it, each with
  /// its port ("shop.example:8080") or without one, for the default port of http and https and
  /// for `port`. Throws InputError for a name that no browser sends.
  /// `max_upload`: bytes of a file.
  Gate(std::vector<std::string> own, std::uint16_t port, std::string token,
       const std::vector<std::string>& names, std::uint64_t max_upload);

  /// In this order: one Host, of the list (else 403); the token (else 404, the same answer as for an unknown
  /// name); GET or HEAD, or PUT of a file (405); no body, but that of a file, whose length is given and
  /// within the limit (411, 413); every Origin, which the WebSocket and a PUT must have, of the list (403);
  /// Sec-Fetch-Site, if present, `same-origin` or `none`, for the WebSocket and a PUT `same-origin` (403). A
  /// link elsewhere may open the page itself, as a top-level document.
  Verdict judge(const Request& request) const;

 private:
  void add(const std::string& host);

  std::string token_;
  std::vector<std::string> hosts_, origins_;
  std::uint64_t max_upload_;
};

}  // namespace shelfbeam::serve::http
