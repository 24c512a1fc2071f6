#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "keenline/progress.h"
#include "keenline/report/image.h"

namespace keenline {

/// The image as a PNG file. \pre the image has pixels \throw OutOfMemory; Cancelled.
[[nodiscard]] std::string png_bytes(const Image& image, const Progress& progress = no_progress());

/// \throw InvalidArgument unless `path` ends in .png.
void require_png_extension(std::string_view path);

/// Writes the image whole or not at all. `before_commit` is called when all is written and only the renaming
/// is left; what it throws leaves the target as it was before.
/// \throw InvalidArgument unless `path` ends in .png; OutputError or Cancelled, with the target as it was
/// before; OutOfMemory.
void write_png(const std::string& path, const Image& image, Progress& progress = no_progress(),
               const std::function<void()>& before_commit = {});

}  // namespace keenline
