#pragma once

#include <string>
#include <string_view>

#include "serve/http/message.hpp"
#include "serve/http/reply.hpp"
#include "serve/http/request.hpp"

namespace shelfbeam::serve::http {

/// A fixed file of the page, kept compressed.
class Asset {
 public:
  /// `type`: its media type. `gzip`: the file in gzip format.
  Asset(std::string type, std::string gzip);
  /// Compresses a file.
  static Asset compressed(std::string type, std::string_view content);

  /// The file as the client wants it: in gzip format or not, or only the news that its copy is current.
  /// Throws std::runtime_error if the client wants it inflated and it is damaged.
  Reply reply(const Request& request) const;

 private:
  std::string type_, etag_;
  Bytes gzip_;
};

}  // namespace shelfbeam::serve::http
