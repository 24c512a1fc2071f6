#include "keenline/report/png.h"

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <png.h>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/output_file.h"
#include "keenline/io/text.h"

namespace keenline {

namespace {

static_assert(sizeof(Color) == 3, "libpng takes the pixels as they lie in memory");

/// Room for as many bytes as a PNG can have: libpng leaves a failed function by longjmp, so nothing that
/// allocates may stand in its way.
struct Target {
  std::string bytes;
  std::size_t used = 0;
};

void append(png_structp png, png_bytep data, std::size_t length) {
  auto* const target = static_cast<Target*>(png_get_io_ptr(png));
  if (length > target->bytes.size() - target->used) png_error(png, "no room");
  std::memcpy(target->bytes.data() + target->used, data, length);
  target->used += length;
}

[[noreturn]] void leave(png_structp png, png_const_charp /*message*/) { png_longjmp(png, 1); }
void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

enum class Outcome : std::uint8_t { Done, NoMemory, Cancelled };

/// Free of objects that a longjmp would not destroy.
Outcome compress(const Image& image, Target& target, const Progress& progress) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    return Outcome::NoMemory;
  }
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return Outcome::NoMemory;
  }
  png_set_write_fn(png, &target, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()),
               8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  // Drawings have few colours and repeat themselves: without differences between pixels they are smaller.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  constexpr int smallest = 9;
  png_set_compression_level(png, smallest);
  png_write_info(png, info);
  bool cancelled = false;
  for (int y = 0; y < image.height() && !cancelled; ++y) {
    const Color* const row = image.pixels().data() + static_cast<std::ptrdiff_t>(y) * image.width();
    png_write_row(png, reinterpret_cast<png_const_bytep>(row));
    cancelled = progress.cancelled();
  }
  if (!cancelled) png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return cancelled ? Outcome::Cancelled : Outcome::Done;
}

}  // namespace

std::string png_bytes(const Image& image, const Progress& progress) {
  const std::size_t raw =
      static_cast<std::size_t>(image.height()) * (3 * static_cast<std::size_t>(image.width()) + 1);
  Target target;
  // What does not compress is stored with 5 bytes for every 16 KB and 12 for every chunk of 8 KB.
  target.bytes.resize(raw + raw / 256 + 4096);
  switch (compress(image, target, progress)) {
    case Outcome::Done: break;
    case Outcome::Cancelled: throw Cancelled();
    case Outcome::NoMemory:
      throw OutOfMemory(fmt::format("no memory to compress {} x {} pixels", image.width(), image.height()));
  }
  target.bytes.resize(target.used);
  return std::move(target.bytes);
}

void require_png_extension(std::string_view path) {
  constexpr std::string_view extension = ".png";
  if (path.size() <= extension.size() ||
      !starts_with_ignoring_case(path.substr(path.size() - extension.size()), extension))
    throw InvalidArgument(fmt::format("output {}: expected a name that ends in .png", quoted(path, 4096)));
}

void write_png(const std::string& path, const Image& image, Progress& progress,
               const std::function<void()>& before_commit) {
  require_png_extension(path);
  OutputFile file(path);
  file.write(png_bytes(image, progress));
  file.store();
  progress.check();
  if (before_commit) before_commit();
  file.commit();
}

}  // namespace keenline
