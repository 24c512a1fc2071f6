// convert_graph GRAPH.json OUT…: any drawing in any format, for the tests that look at the files from
// outside.
#include <cstdio>
#include <string>
#include <vector>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"

int main(int argc, char** argv) {
  try {
    keenline::write_graph(std::vector<std::string>(argv + 2, argv + argc), keenline::read_graph(argv[1]));
    return 0;
  } catch (const keenline::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
