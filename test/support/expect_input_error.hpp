#pragma once

#include <exception>
#include <functional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam::test {

/// The message of the InputError that `action` throws. Without an InputError: a test failure and an empty
/// text.
inline std::string input_error(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another exception instead of InputError: " << error.what();
    return {};
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

/// Expects an InputError whose message contains all parts.
inline void expect_input_error(const std::function<void()>& action, std::string_view part,
                               std::string_view second = "", std::string_view third = "",
                               std::string_view fourth = "") {
  const std::string message = input_error(action);
  for (const std::string_view expected : {part, second, third, fourth})
    EXPECT_NE(message.find(expected), std::string::npos) << "'" << expected << "' is not in: " << message;
}

/// Expects that `read` refuses a file of this content, with its path and all parts in the message.
inline void expect_file_refused(const std::function<void(const std::filesystem::path&)>& read,
                                std::string_view content, std::string_view part = "",
                                std::string_view second = "", std::string_view third = "") {
  const TempFolder folder;
  const auto path = folder.write("file", content);
  expect_input_error([&] { read(path); }, path.string(), part, second, third);
}

}  // namespace shelfbeam::test
