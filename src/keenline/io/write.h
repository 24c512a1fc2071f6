#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/progress.h"

namespace keenline {

/// \throw InvalidArgument unless the extension of `path` names a format that can be written: .ply or .csv.
void require_writable_extension(std::string_view path);

/// Whether the format that `path` names holds attributes that are lists of varying length: .csv does not.
/// \throw as require_writable_extension()
[[nodiscard]] bool holds_lists(std::string_view path);

/// What is to be done when all is written and only the renaming is left, with the notes; what it throws
/// leaves the target as it was before.
using BeforeCommit = std::function<void(const std::vector<std::string>& notes)>;

/// Writes the cloud with every attribute, whole or not at all: beside the target first, flushed, then
/// renamed. The format follows the extension: .ply (binary little endian) or .csv. Returns notes: what the
/// format could not hold as it was. \throw InvalidArgument for another extension; OutputError, with the
/// target as it was before; Cancelled.
std::vector<std::string> write_cloud(const std::string& path, const PointCloud& cloud,
                                     Progress& progress = no_progress(),
                                     const BeforeCommit& before_commit = {});

}  // namespace keenline
