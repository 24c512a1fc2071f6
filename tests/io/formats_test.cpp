#include "keenline/io/formats.h"

#include <set>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

std::string_view format_of(std::string name, std::string_view bytes) {
  return find_format({std::move(name), bytes}).name;
}

TEST(Formats, ContentDecidesWhateverTheNameSays) {
  constexpr std::string_view ply =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n";
  EXPECT_EQ(format_of("a.ply", ply), "ply");
  EXPECT_EQ(format_of("a.xyz", ply), "ply");
  EXPECT_EQ(format_of("a", ply), "ply");
  EXPECT_EQ(format_of("a.xyz", "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"), "pcd");
  EXPECT_EQ(format_of("a.txt", "OFF\n0 0 0\n"), "off");
  EXPECT_EQ(format_of("a.bin", "LASF and so on"), "las");
  EXPECT_EQ(format_of("a.dat", "solid x\nfacet normal 0 0 1\nouter loop\n"), "stl");
}

TEST(Formats, ABinaryStlIsKnownByItsSizeWhateverItsTitle) {
  for (const std::string title : {"OFF to STL", "VERSION 2", "LASF", "solid part", "# .PCD"}) {
    std::string stl = title;
    stl.resize(84 + 50);
    stl[80] = 1;
    EXPECT_EQ(format_of("a.dat", stl), "stl") << title;
  }
}

TEST(Formats, TheExtensionDecidesWhereContentDoesNot) {
  EXPECT_EQ(format_of("a.ply", "1 2 3\n4 5 6\n"), "ply");  // and the PLY reader refuses it
  EXPECT_EQ(format_of("dir.ply/A.XYZ", "1 2 3\n"), "xyz");
  EXPECT_EQ(format_of("a.OBJ", "1 2 3\n"), "obj");
}

TEST(Formats, WeakContentDecidesWithoutAKnownExtension) {
  EXPECT_EQ(format_of("cloud", "1 2 3\n4 5 6\n"), "xyz");
  EXPECT_EQ(format_of("a.ply/cloud", "x,y,z\n1,2,3\n"), "xyz");
  EXPECT_EQ(format_of("mesh.dat", "# made by hand\nv 1 2 3\n"), "obj");
}

TEST(Formats, RefusesWhatNoFormatFits) {
  test::expect_error<InputError>(
      [] {
        (void)find_format({"a.jpg", "\xff\xd8\xff\xe0 JFIF"});
      },
      "a.jpg: byte 0", "'\\xff\\xd8", "ply, pcd, las");
  test::expect_error<InputError>([] { (void)find_format({"nothing", ""}); }, "an empty file");
}

TEST(Formats, NamesAndExtensionsAreUnique) {
  std::set<std::string_view> names;
  std::set<std::string_view> extensions;
  for (const Format& format : formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    for (const std::string_view extension : format.extensions)
      EXPECT_TRUE(extensions.insert(extension).second) << extension;
  }
  EXPECT_EQ(formats().size(), 7U);
}

}  // namespace
}  // namespace keenline
