#pragma once

#include <string>

#include "serve/http/message.hpp"
#include "serve/http/reply.hpp"
#include "serve/http/request.hpp"

namespace shelfbeam::serve::http {

/// A fixed file of the page. It is sent in gzip format only, which all browsers take.
class Asset {
 public:
  /// `type`: its media type. `gzip`: the file in gzip format.
  Asset(std::string type, std::string gzip);
  /// The file, or only the news that the client's copy is current.
  Reply reply(const Request& request) const;

 private:
  std::string type_, etag_;
  Bytes gzip_;
};

}  // namespace shelfbeam::serve::http
