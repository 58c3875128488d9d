#include "serve/http/asset.hpp"

#include <utility>

#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::serve::http {

Asset::Asset(std::string type, std::string gzip)
    : type_(std::move(type)),
      etag_('"' + content_hash(gzip) + '"'),
      gzip_(std::make_shared<const std::string>(std::move(gzip))) {}

Reply Asset::reply(const Request& request) const {
  if (request.lists("if-none-match", etag_)) return {.status = 304, .etag = etag_};
  return {.type = type_, .body = gzip_, .is_gzip = true, .etag = etag_};
}

}  // namespace shelfbeam::serve::http
