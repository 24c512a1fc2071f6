#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace keenline {

/// The bytes of one input, and the name that messages give it. Readers work on this, so that they can be
/// tested and fuzzed without files.
struct Source {
  std::string name;
  std::string_view bytes;
};

/// A regular file mapped into memory for reading.
class MappedFile {
 public:
  /// \throw InputError when `path` cannot be opened or is not a regular file (folder, pipe, device).
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] Source source() const { return {path_, {data_, size_}}; }

 private:
  std::string path_;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace keenline
