#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "keenline/kernels/target.h"

namespace keenline {

/// Runs `function` once on every instruction set that this CPU has, scalar first, and names it in failures.
template <typename Function>
void on_each_target(Function function) {
  const std::string before(kernels::target());
  for (const std::string_view name : kernels::supported_targets()) {
    kernels::use_target(name);
    SCOPED_TRACE(name);
    function();
  }
  kernels::use_target(before);
}

}  // namespace keenline
