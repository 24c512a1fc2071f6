#pragma once

#include <cstdint>
#include <string_view>

namespace keenline {

/// Bytes that this process can still be given: the least of free physical memory, what the control group
/// allows and what the address-space limit leaves. The largest value when the system does not tell.
[[nodiscard]] std::uint64_t available_memory();

/// Largest resident size of this process so far, in bytes.
[[nodiscard]] std::uint64_t peak_memory();

/// A refusal in words now beats the kernel's kill later.
/// \throw OutOfMemory "WHAT needs 12.0 GiB of memory, 3.1 GiB are available" when there is too little.
void require_memory(std::uint64_t bytes, std::string_view what);

}  // namespace keenline
