#include "keenline/progress.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

class Stoppable : public Progress {
 public:
  [[nodiscard]] bool cancelled() const override { return stop; }
  bool stop = false;
};

TEST(Progress, CheckThrowsOnceCancelled) {
  Stoppable progress;
  EXPECT_NO_THROW(progress.check());
  progress.stop = true;
  EXPECT_THROW(progress.check(), Cancelled);
}

TEST(Progress, TheSilentOneNeverCancels) {
  no_progress().begin("stage", 10);
  no_progress().advance(20);
  EXPECT_NO_THROW(no_progress().check());
}

}  // namespace
}  // namespace keenline
