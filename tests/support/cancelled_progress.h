#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "keenline/progress.h"

namespace keenline::test {

/// Cancels from the n-th time on that it is asked: at once, unless told otherwise.
class CancelledProgress : public Progress {
 public:
  explicit CancelledProgress(std::uint64_t at = 1) : at_(at) {}

  [[nodiscard]] bool cancelled() const override { return ++asked_ >= at_; }
  /// How often it was asked so far.
  [[nodiscard]] std::uint64_t asked() const { return asked_; }

 private:
  std::uint64_t at_;
  mutable std::atomic<std::uint64_t> asked_ = 0;
};

/// Some twenty numbers from 1 to `most`, both included: where to cancel work that asks so often.
inline std::vector<std::uint64_t> some_up_to(std::uint64_t most) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t at = 1; at < most; at += 1 + most / 20) numbers.push_back(at);
  numbers.push_back(most);
  return numbers;
}

}  // namespace keenline::test
