#include "keenline/require.h"

#include <cmath>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {

void require_option(bool ok, std::string_view name, double found, std::string_view expected) {
  if (!ok) throw InvalidArgument(fmt::format("{}: found {}, expected {}", name, found, expected));
}

void require_in_range(std::string_view name, double found, double least, double most) {
  const bool is_in_range = found >= least && found <= most;  // never a NaN
  if (is_in_range) return;
  require_option(false, name, found,
                 std::isinf(most) ? fmt::format("{} or more", least) : fmt::format("{} to {}", least, most));
}

}  // namespace keenline
