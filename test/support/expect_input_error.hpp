#pragma once

#include <exception>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam::test {

/// The message of the InputError that `action` throws. Without an InputError: a test failure and an empty
/// text.
template <class Action>
std::string input_error(const Action& action) {
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

/// Expects an InputError whose message contains all `parts`.
template <class Action, class... Parts>
void expect_input_error(const Action& action, const Parts&... parts) {
  const std::string message = input_error(action);
  for (const std::string_view part : {std::string_view(parts)...})
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
}

/// Expects that `read` refuses a file of this content, with its path and all `parts` in the message.
template <class Read, class... Parts>
void expect_file_refused(const Read& read, std::string_view content, const Parts&... parts) {
  const TempFolder folder;
  const auto path = folder.write("file", content);
  expect_input_error([&] { read(path); }, path.string(), parts...);
}

}  // namespace shelfbeam::test
