#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>

namespace keenline {

/// Gives every name once: the second "a" becomes "a_2", the third "a_3".
class UniqueNames {
 public:
  /// These are taken already.
  explicit UniqueNames(std::initializer_list<std::string_view> taken = {});

  /// `wanted`, or the first of wanted_2, wanted_3, … that is still free. It is taken from now on.
  [[nodiscard]] std::string claim(const std::string& wanted);

 private:
  // With the number to try next, so that many equal names take linear time.
  std::unordered_map<std::string, std::uint64_t> taken_;
};

}  // namespace keenline
