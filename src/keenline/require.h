#pragma once

#include <string_view>

namespace keenline {

// How options are refused. The name is that of the member, the message in one form: "NAME: found FOUND,
// expected EXPECTED".

/// \throw InvalidArgument unless `ok`.
void require_option(bool ok, std::string_view name, double found, std::string_view expected);

/// `most` may be infinite. \throw InvalidArgument unless least <= found <= most, so for a NaN too.
void require_in_range(std::string_view name, double found, double least, double most);

}  // namespace keenline
