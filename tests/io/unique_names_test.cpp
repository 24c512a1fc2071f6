#include "keenline/io/unique_names.h"

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(UniqueNames, NumbersWhatIsTaken) {
  UniqueNames names({"x"});
  EXPECT_EQ(names.claim("a"), "a");
  EXPECT_EQ(names.claim("a"), "a_2");
  EXPECT_EQ(names.claim("a"), "a_3");
  EXPECT_EQ(names.claim("x"), "x_2");
}

TEST(UniqueNames, StepsOverNumbersThatAreTaken) {
  UniqueNames names;
  EXPECT_EQ(names.claim("a_2"), "a_2");
  EXPECT_EQ(names.claim("a"), "a");
  EXPECT_EQ(names.claim("a"), "a_3");
  EXPECT_EQ(names.claim("a_2"), "a_2_2");
}

}  // namespace
}  // namespace keenline
