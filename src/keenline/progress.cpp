#include "keenline/progress.h"

#include "keenline/errors.h"

namespace keenline {

void Progress::check() const {
  if (cancelled()) throw Cancelled();
}

Progress& no_progress() {
  static Progress silent;
  return silent;
}

}  // namespace keenline
