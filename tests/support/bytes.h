#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace keenline::test {

/// Puts a binary file together, number by number.
class Bytes {
 public:
  explicit Bytes(std::string_view text = {}, std::endian order = std::endian::little)
      : text_(text), order_(order) {}

  template <typename T>
  Bytes& add(T value) {
    text_.append(sizeof value, '\0');
    return put(text_.size() - sizeof value, value);
  }
  template <typename T, typename... More>
  Bytes& add(T value, More... more) {
    return add(value).add(more...);
  }
  Bytes& text(std::string_view text) {
    text_ += text;
    return *this;
  }
  /// Overwrites what stands at `offset`.
  template <typename T>
  Bytes& put(std::size_t offset, T value) {
    char* const bytes = text_.data() + offset;
    std::memcpy(bytes, &value, sizeof value);
    if (order_ != std::endian::native) std::reverse(bytes, bytes + sizeof value);
    return *this;
  }
  Bytes& put(std::size_t offset, std::string_view text) {
    text_.replace(offset, text.size(), text);
    return *this;
  }

  [[nodiscard]] const std::string& str() const { return text_; }
  [[nodiscard]] std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
  std::endian order_;
};

}  // namespace keenline::test
