#pragma once

#include <string_view>
#include <vector>

namespace keenline::kernels {

/// Name of the instruction set that the kernels run on: the best that this CPU has, unless the environment
/// variable KEENLINE_TARGET or use_target() names another. All give the same bits. Threads: any.
/// \throw InvalidArgument when KEENLINE_TARGET names none of supported_targets().
[[nodiscard]] std::string_view target();

/// What this CPU can run, slowest first: "scalar", which is plain C++, then of "sse4", "avx2", "avx512" (x86)
/// or "neon" (ARM) those it has.
[[nodiscard]] std::vector<std::string_view> supported_targets();

/// From here on the kernels run on that one. Threads: none may be inside a kernel.
/// \throw InvalidArgument when it is none of supported_targets().
void use_target(std::string_view name);

/// Whether the kernels are to run their plain C++; asked at the door of each. \throw as target()
[[nodiscard]] bool target_is_scalar();

}  // namespace keenline::kernels
