#include "records.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::fuzz {

// Records follow the first line: length, hash of the content, hash of both and the position, content.
void repair_records(std::string& bytes) {
  std::size_t at = bytes.find('\n');
  if (at == std::string::npos) return;
  for (++at; bytes.size() - at >= 24;) {
    std::array<std::uint64_t, 3> head{};
    std::memcpy(head.data(), bytes.data() + at, sizeof head);
    const std::size_t left = bytes.size() - at - sizeof head;
    const std::uint64_t length = std::min<std::uint64_t>(head[0], left);
    head[1] = hash64(std::string_view(bytes).substr(at + sizeof head, length));
    // A length beyond the end stays, because a truncated record at the end has one.
    const std::array<std::uint64_t, 3> hashed{head[0], head[1], at};
    head[2] = hash64({reinterpret_cast<const char*>(hashed.data()), sizeof hashed});
    std::memcpy(bytes.data() + at, head.data(), sizeof head);
    at += sizeof head + length;
  }
}

}  // namespace shelfbeam::fuzz
