#include "keenline/io/output_file.h"

#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::expect_error;
using test::TemporaryFolder;

TEST(OutputFile, AppearsWholeOnCommit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.bin");
  const std::string large(3'000'001, 'x');
  OutputFile file(path);
  file.write("head");
  file.write(large);
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(path), "head" + large);
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, StoredIsNotYetThere) {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.bin", "old");
  OutputFile file(path);
  file.write("new");
  file.store();
  EXPECT_EQ(TemporaryFolder::read(path), "old");
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(path), "new");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  folder.write("old", "old");
  {
    OutputFile file(folder.file("old"));
    file.write("new");
    OutputFile other(folder.file("other"));
    EXPECT_EQ(folder.entries(), 3U);
  }
  EXPECT_EQ(folder.entries(), 1U);
  EXPECT_EQ(TemporaryFolder::read(folder.file("old")), "old");
}

TEST(OutputFile, ReplacesAndKeepsPermissions) {
  const TemporaryFolder folder;
  const std::string path = folder.write("private", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  OutputFile file(path);
  file.write("new");
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(path), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0600));
}

TEST(OutputFile, WritesWhereASymbolicLinkPoints) {
  const TemporaryFolder folder;
  const std::string path = folder.write("real", "old");
  std::filesystem::create_symlink("real", folder.path() / "link");
  OutputFile file(folder.file("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(TemporaryFolder::read(path), "new");
}

TEST(OutputFile, RefusesTargetsThatCannotBe) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  std::filesystem::create_symlink("nowhere", folder.path() / "broken");
  std::filesystem::create_directory(folder.path() / "sub");
  expect_error<OutputError>([&] { OutputFile file(folder.file("missing/out")); },
                            "missing/out: cannot be written", "No such file");
  expect_error<OutputError>([&] { OutputFile file(folder.file("sub")); }, "it is a folder");
  expect_error<OutputError>([&] { OutputFile file(folder.file("loop")); }, "symbolic link");
  expect_error<OutputError>([&] { OutputFile file(folder.file("broken")); }, "symbolic link");
  expect_error<OutputError>([] { OutputFile file("/dev/null"); }, "not a regular file");
  expect_error<OutputError>([] { OutputFile file(""); }, "not a file name");
  EXPECT_EQ(folder.entries(), 3U);
}

TEST(OutputFile, TakesTheLongestNames) {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string(255, 'n'));
  OutputFile file(path);
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(OutputFile, AFailedWriteLeavesNothing) {
  const TemporaryFolder folder;
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{1000, old.rlim_max};
  void (*const old_handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_error<OutputError>(
      [&] {
        OutputFile file(folder.file("out"));
        file.write(std::string(5000, 'x'));
        file.commit();
      },
      "out: cannot be written", "File too large");
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(OutputFile, UnfinishedOutputCanBeRemovedFromASignalHandler) {
  const TemporaryFolder folder;
  OutputFile file(folder.file("out"));
  ASSERT_EQ(folder.entries(), 1U);
  remove_unfinished_output();
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(OutputFile, TheInputIsNeverTheOutput) {
  const TemporaryFolder folder;
  const std::string input = folder.write("cloud.ply", "points");
  const std::string other = folder.write("other.ply", "points");
  std::filesystem::create_symlink(input, folder.file("link.ply"));
  EXPECT_NO_THROW(require_different_files(input, other));
  EXPECT_NO_THROW(require_different_files(input, folder.file("new.ply")));
  EXPECT_NO_THROW(require_different_files(folder.file("none"), folder.file("none")));
  for (const std::string& same : {input, folder.file("./cloud.ply"), folder.file("link.ply")})
    expect_error<InvalidArgument>([&] { require_different_files(input, same); }, "is the input");
}

TEST(OutputFile, NoOutputIsNamedTwice) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder.path(), folder.path() / "again");
  const std::string path = folder.file("a.ply");
  EXPECT_NO_THROW(require_distinct_outputs(std::vector{path, folder.file("b.ply")}));
  for (const std::string& same : {path, folder.file("./a.ply"), folder.file("again/a.ply")})
    expect_error<InvalidArgument>([&] { require_distinct_outputs(std::vector{path, same}); }, "named twice");
}

}  // namespace
}  // namespace keenline
