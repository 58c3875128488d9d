#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam::test {

enum class Opcode : unsigned { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

/// A frame of a WebSocket (RFC 6455, section 5.2), right or wrong in every part.
struct Frame {
  Opcode opcode = Opcode::text;
  std::string payload = {};
  bool is_last = true;
  unsigned reserved = 0;  ///< bits RSV1 to RSV3 as 4, 2, 1
  bool is_masked = true;
  std::optional<std::uint64_t> declared_size = {};  ///< other than that of the payload

  /// The status of a close frame, 0 without one.
  unsigned code() const {
    if (opcode != Opcode::close || payload.size() < 2) return 0;
    return static_cast<unsigned char>(payload[0]) * 256U + static_cast<unsigned char>(payload[1]);
  }

  std::string bytes() const {
    std::string out(
        1, static_cast<char>((is_last ? 128U : 0U) | reserved << 4U | static_cast<unsigned>(opcode)));
    const std::uint64_t size = declared_size.value_or(payload.size());
    const unsigned mask_bit = is_masked ? 128 : 0;
    const int more = size < 126 ? 0 : size < 65536 ? 2 : 8;
    out += static_cast<char>(mask_bit | (more == 0 ? static_cast<unsigned>(size) : more == 2 ? 126U : 127U));
    for (int byte = more; byte > 0; --byte) out += static_cast<char>(size >> (8 * (byte - 1)) & 255U);
    if (!is_masked) return out + payload;
    constexpr std::string_view mask = "\x12\x34\x56\x78";
    out += mask;
    for (std::size_t i = 0; i < payload.size(); ++i) out += static_cast<char>(payload[i] ^ mask[i % 4]);
    return out;
  }
};

/// Takes a frame of a server, which is not masked, from the front of `bytes`; nothing if it is not complete.
inline std::optional<Frame> take_frame(std::string& bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() < 2) return std::nullopt;
  Frame frame{.opcode = static_cast<Opcode>(byte(0) & 15U), .is_masked = (byte(1) & 128U) != 0};
  frame.is_last = (byte(0) & 128U) != 0;
  frame.reserved = byte(0) >> 4U & 7U;
  std::uint64_t size = byte(1) & 127U;
  const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0;
  if (bytes.size() < 2 + more) return std::nullopt;
  if (more > 0) size = 0;
  for (std::size_t i = 0; i < more; ++i) size = size << 8U | byte(2 + i);
  if (bytes.size() < 2 + more + size) return std::nullopt;
  frame.payload = bytes.substr(2 + more, size);
  bytes.erase(0, 2 + more + size);
  return frame;
}

}  // namespace shelfbeam::test
