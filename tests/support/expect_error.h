#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace keenline::test {

/// Runs `function`, which must throw an Exception whose message contains every one of `parts`.
template <typename Exception, typename Function, typename... Parts>
void expect_error(Function&& function, const Parts&... parts) {
  try {
    function();
  } catch (const Exception& e) {
    const std::string message = e.what();
    const auto expect_part = [&](std::string_view part) {
      EXPECT_NE(message.find(part), std::string::npos) << "message: " << message << "\nmissing: " << part;
    };
    (expect_part(parts), ...);
    EXPECT_EQ(message.find('\n'), std::string::npos) << "an error message is one line";
    return;
  }
  ADD_FAILURE() << "nothing was thrown";
}

}  // namespace keenline::test
