#include "rivals.h"

namespace keenline::bench {

std::vector<Rival> rivals() {
  return {
#ifdef KEENLINE_BENCH_CGAL
      {"CGAL vcm", cgal_edges},
#endif
#ifdef KEENLINE_BENCH_PCL
      {"PCL boundary", pcl_boundaries},
#endif
  };
}

}  // namespace keenline::bench
