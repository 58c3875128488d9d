#pragma once

#include <string>
#include <string_view>

namespace shelfbeam::serve::http {

/// A secret for the address of a server: 128 random bits from the kernel as 32 hexadecimal digits. Throws
/// std::system_error if the kernel gives none.
std::string make_token();

/// Whether a text is the secret; false for an empty secret. The time does not depend on where they differ.
bool is_secret(std::string_view given, std::string_view secret);

}  // namespace shelfbeam::serve::http
