#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "keenline/progress.h"

namespace keenline::synth {

/// Calls function(i) for every i below `count`, on any number of threads, telling `progress` of each.
template <typename Function>
void for_each_index(std::size_t count, Progress& progress, const Function& function) {
  constexpr std::size_t grain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    for (std::size_t begin = range.begin(); begin < range.end(); begin += grain) {
      progress.check();
      const std::size_t end = begin + grain < range.end() ? begin + grain : range.end();
      for (std::size_t i = begin; i < end; ++i) function(i);
      progress.advance(end - begin);
    }
  });
}

}  // namespace keenline::synth
