#include "serve/http/asset.hpp"

#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <zlib.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve::http {

namespace {

constexpr int gzip_window = 15 + 16;  // zlib's number for a gzip header around the largest window

void feed(z_stream& stream, std::string_view bytes) {
  // zlib does not write to its input.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
}

// Calls `step` (deflate or inflate) until its output ends.
template <class Step>
std::string output_of(z_stream& stream, Step step) {
  std::string out;
  int state = Z_OK;
  while (state == Z_OK) {
    const std::size_t size = out.size();
    out.resize(size + (std::size_t{1} << 16));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + size);
    stream.avail_out = static_cast<uInt>(out.size() - size);
    state = step(&stream, Z_FINISH);
    if (state == Z_BUF_ERROR && stream.avail_out == 0) state = Z_OK;  // the piece of output is full
    out.resize(out.size() - stream.avail_out);
  }
  if (state != Z_STREAM_END) throw std::runtime_error("a file of the page is damaged");
  return out;
}

std::string deflated(std::string_view content) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, deflateEnd);
  feed(stream, content);
  return output_of(stream, deflate);
}

std::string inflated(std::string_view gzip) {
  z_stream stream{};
  if (inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  feed(stream, gzip);
  return output_of(stream, inflate);
}

}  // namespace

// The tag is weak because it names both forms, compressed and not.
Asset::Asset(std::string type, std::string gzip)
    : type_(std::move(type)),
      etag_("W/\"" + content_hash(gzip) + "\""),
      gzip_(std::make_shared<const std::string>(std::move(gzip))) {}

Asset Asset::compressed(std::string type, std::string_view content) {
  return {std::move(type), deflated(content)};
}

Reply Asset::reply(const Request& request) const {
  if (request.lists("if-none-match", lower_case(etag_))) return {.status = 304, .etag = etag_};
  if (request.accepts_gzip()) return {.type = type_, .body = gzip_, .is_gzip = true, .etag = etag_};
  return {.type = type_, .body = std::make_shared<const std::string>(inflated(*gzip_)), .etag = etag_};
}

}  // namespace shelfbeam::serve::http
