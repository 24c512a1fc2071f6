#include "keenline/io/read.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

TEST(Read, ReadsByContentAndNamesTheFormat) {
  const test::TemporaryFolder folder;
  const Reading reading = read_cloud(folder.write("points.whatever", "1 2 3\n-4 5e-1 6\n"));
  EXPECT_EQ(reading.format, "xyz");
  ASSERT_EQ(reading.cloud.size(), 2U);
  EXPECT_EQ(reading.cloud.positions[1], (Point{-4, 0.5, 6}));
}

TEST(Read, NamesTheFileInErrors) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("bad.xyz", "1 2 3\n4 five 6\n");
  test::expect_error<InputError>([&] { (void)read_cloud(path); }, path + ": line 2", "'five'");
}

TEST(Read, RefusesFilesThatSayNothing) {
  const test::TemporaryFolder folder;
  for (const char* extension : {"ply", "pcd", "las", "off", "obj", "stl", "xyz", "dat"}) {
    const std::string path = folder.write(std::string("a.") + extension, "");
    test::expect_error<InputError>([&] { (void)read_cloud(path); }, path + ": byte 0", "an empty file");
  }
  const std::string path = folder.write("a.obj", "\xEF\xBB\xBF \t\r\n\n");
  test::expect_error<InputError>([&] { (void)read_cloud(path); }, path + ": byte 0", "nothing but blanks");
}

TEST(Read, CanBeCancelled) {
  const test::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "1 2 3\n";
  const std::string path = folder.write("long.xyz", text);
  test::CancelledProgress progress;
  EXPECT_THROW((void)read_cloud(path, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
