#include "keenline/report/png.h"

#include <filesystem>
#include <png.h>
#include <stdexcept>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

Image colorful(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(11 * y + x),
                        static_cast<std::uint8_t>(x * y)};
  return image;
}

Image decoded(const std::string& bytes) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&description, bytes.data(), bytes.size()) == 0)
    throw std::runtime_error(description.message);
  EXPECT_EQ(description.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  description.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(description.width), static_cast<int>(description.height));
  if (png_image_finish_read(&description, nullptr, &image.at(0, 0), 0, nullptr) == 0)
    throw std::runtime_error(description.message);
  return image;
}

void expect_equal(const Image& a, const Image& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin()));
}

TEST(Png, ComesBackAsItWas) {
  for (const auto& [width, height] : {std::pair{1, 1}, {37, 5}, {300, 200}}) {
    const Image image = colorful(width, height);
    expect_equal(decoded(png_bytes(image)), image);
  }
}

TEST(Png, SameImageSameBytes) { EXPECT_EQ(png_bytes(colorful(40, 30)), png_bytes(colorful(40, 30))); }

TEST(Png, IsWrittenWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  const Image image = colorful(20, 10);
  write_png(folder.file("a.PNG"), image);
  expect_equal(decoded(test::TemporaryFolder::read(folder.file("a.PNG"))), image);

  folder.write("old.png", "old");
  const auto refuse = [] { throw std::runtime_error("nobody listens"); };
  EXPECT_THROW(write_png(folder.file("old.png"), image, no_progress(), refuse), std::runtime_error);
  EXPECT_EQ(test::TemporaryFolder::read(folder.file("old.png")), "old");
  EXPECT_EQ(folder.entries(), 2U);
}

TEST(Png, SaysWhatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const Image image(4, 4);
  test::expect_error<OutputError>([&] { write_png(folder.file("none/a.png"), image); }, "none/a.png",
                                  "cannot be written");
  std::filesystem::create_directory(folder.file("b.png"));
  test::expect_error<OutputError>([&] { write_png(folder.file("b.png"), image); }, "is a folder");
}

TEST(Png, WhatDoesNotCompressHasRoomToo) {
  Image image(700, 300);
  std::uint32_t state = 1;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      state = state * 1664525U + 1013904223U;
      image.at(x, y) = {static_cast<std::uint8_t>(state >> 24U), static_cast<std::uint8_t>(state >> 16U),
                        static_cast<std::uint8_t>((state >> 25U) ^ (state >> 13U))};
    }
  }
  expect_equal(decoded(png_bytes(image)), image);
}

TEST(Png, CanBeStopped) {
  const test::TemporaryFolder folder;
  test::CancelledProgress stop;
  EXPECT_THROW(write_png(folder.file("a.png"), colorful(20, 10), stop), Cancelled);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Png, OnlyPngIsWritten) {
  for (const char* name : {"a.jpg", "png", ".png", "a.png.txt", ""})
    test::expect_error<InvalidArgument>([&] { require_png_extension(name); }, ".png");
  EXPECT_NO_THROW(require_png_extension("folder/a.png"));
}

}  // namespace
}  // namespace keenline
