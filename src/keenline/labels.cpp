#include "keenline/labels.h"

namespace keenline {

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::Flat: return "flat";
    case Kind::Curved: return "curved";
    case Kind::Edge: return "edge";
    case Kind::Corner: return "corner";
    case Kind::Peak: return "peak";
    case Kind::Border: return "border";
    case Kind::Undecided: break;
  }
  return "undecided";
}

}  // namespace keenline
