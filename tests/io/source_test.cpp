#include "keenline/io/source.h"

#include <filesystem>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::expect_error;

TEST(Source, MapsTheBytesOfAFile) {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\n", 4);
  const std::string path = folder.write("x y\n.bin", bytes);
  const MappedFile file(path);
  EXPECT_EQ(file.source().bytes, bytes);
  EXPECT_EQ(file.source().name, path);
}

TEST(Source, MapsAnEmptyFile) {
  const test::TemporaryFolder folder;
  const MappedFile file(folder.write("empty", ""));
  EXPECT_TRUE(file.source().bytes.empty());
}

TEST(Source, RefusesWhatIsNoRegularFile) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  expect_error<InputError>([&] { MappedFile file(folder.file("nothing")); }, "nothing: cannot be opened",
                           "No such file");
  expect_error<InputError>([&] { MappedFile file(folder.path().string()); }, "is a folder");
  expect_error<InputError>([&] { MappedFile file(folder.file("pipe")); }, "is a pipe");
  expect_error<InputError>([&] { MappedFile file(folder.file("loop")); }, "cannot be opened");
  expect_error<InputError>([] { MappedFile file("/dev/zero"); }, "is a device");
  expect_error<InputError>([] { MappedFile file(std::string("a\0b", 3)); }, "zero byte");
}

}  // namespace
}  // namespace keenline
