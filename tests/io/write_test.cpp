#include "keenline/io/write.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/read.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

PointCloud small_cloud() {
  PointCloud cloud;
  cloud.positions = {{4500000.123, 5.4e6 + 0.001, -1e-200}, {0.1, -0.0, 1e308}};
  cloud.set_attribute(Column("intensity", std::vector<std::uint16_t>{65535, 0}));
  return cloud;
}

TEST(Write, ExtensionChoosesTheFormatAndNothingIsLost) {
  const test::TemporaryFolder folder;
  const PointCloud cloud = small_cloud();
  for (const char* const name : {"a.ply", "a.PLY", "a.csv", "b.Csv"}) {
    EXPECT_TRUE(write_cloud(folder.file(name), cloud).empty());
    const Reading back = read_cloud(folder.file(name));
    EXPECT_EQ(back.format, name[2] == 'p' || name[2] == 'P' ? "ply" : "xyz");
    EXPECT_EQ(back.cloud.positions, cloud.positions);
    ASSERT_NE(back.cloud.attribute("intensity"), nullptr);
    EXPECT_EQ(back.cloud.attribute("intensity")->value(0), 65535);
  }
}

TEST(Write, RefusesOtherExtensionsBeforeAnythingIsWritten) {
  const test::TemporaryFolder folder;
  for (const char* const name : {"a.xyz", "a", "ply", "a.ply.gz"}) {
    test::expect_error<InvalidArgument>([&] { write_cloud(folder.file(name), small_cloud()); }, name,
                                        ".ply or .csv");
    test::expect_error<InvalidArgument>([&] { require_writable_extension(name); }, name);
  }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Write, TellsWhichFormatsHoldLists) {
  EXPECT_TRUE(holds_lists("a.PLY"));
  EXPECT_FALSE(holds_lists("a.csv"));
  test::expect_error<InvalidArgument>([&] { (void)holds_lists("a.txt"); }, "a.txt");
}

TEST(Write, AFailureLeavesNothing) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_cloud(folder.file("no/such/folder.ply"), small_cloud()), OutputError);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Write, WhatIsDoneBeforeTheCommitCanPreventIt) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.ply", "old");
  const auto fail = [&](const std::vector<std::string>&) {
    EXPECT_EQ(folder.entries(), 2U);
    EXPECT_EQ(test::TemporaryFolder::read(path), "old");
    throw OutputError("standard output", "cannot be written");
  };
  test::expect_error<OutputError>([&] { write_cloud(path, small_cloud(), no_progress(), fail); },
                                  "standard output");
  EXPECT_EQ(folder.entries(), 1U);
  EXPECT_EQ(test::TemporaryFolder::read(path), "old");
}

}  // namespace
}  // namespace keenline
