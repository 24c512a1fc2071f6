#include "keenline/kernels/average_linkage.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace keenline::kernels {
namespace {

using Slot = LinkageWorkspace::Slot;

/// The clusters that are still to be merged: slots 0 … active-1 of a matrix whose rows keep their first
/// length.
template <typename Sum>
struct Clusters {
  Sum* sums;  // sums[a * stride + b]: sum of distances between the items of a and those of b
  std::size_t stride;
  Slot* slots;
  std::size_t active;
};

/// Slot of the cluster nearest to `slot`: least mean distance, then least name (which for a fixed `slot` is
/// the order of pairs by (smaller name, larger name)). The means' common factor 1 / size(slot) is left out,
/// and fractions are compared crosswise: sums stay below 2^44 and sizes below 2^15, so products fit 64 bits.
template <typename Sum>
std::size_t nearest(const Clusters<Sum>& clusters, std::size_t slot) {
  const Sum* const row = clusters.sums + slot * clusters.stride;
  std::size_t best = slot == 0 ? 1 : 0;
  std::uint64_t best_sum = row[best];
  std::uint64_t best_size = clusters.slots[best].size;
  for (std::size_t other = best + 1; other < clusters.active; ++other) {
    if (other == slot) continue;
    const std::uint64_t mine = row[other] * best_size;
    const std::uint64_t to_beat = best_sum * clusters.slots[other].size;
    if (mine > to_beat) continue;
    if (mine == to_beat && clusters.slots[other].name > clusters.slots[best].name) continue;
    best = other;
    best_sum = row[other];
    best_size = clusters.slots[other].size;
  }
  return best;
}

template <typename Sum>
Merge merged(const Clusters<Sum>& clusters, std::size_t a, std::size_t b) {
  Slot first = clusters.slots[a];
  Slot second = clusters.slots[b];
  if (second.name < first.name) std::swap(first, second);
  const double pairs = static_cast<double>(first.size) * second.size;
  return {first.name, second.name, first.size, second.size,
          static_cast<double>(clusters.sums[a * clusters.stride + b]) / pairs};
}

/// Puts b's items into a, and the last active cluster where b was.
template <typename Sum>
void join(Clusters<Sum>& clusters, std::size_t a, std::size_t b) {
  Sum* const sums = clusters.sums;
  const std::size_t stride = clusters.stride;
  for (std::size_t other = 0; other < clusters.active; ++other)
    sums[a * stride + other] += sums[b * stride + other];
  for (std::size_t other = 0; other < clusters.active; ++other)
    sums[other * stride + a] = sums[a * stride + other];
  clusters.slots[a].name = std::min(clusters.slots[a].name, clusters.slots[b].name);
  clusters.slots[a].size += clusters.slots[b].size;

  const std::size_t last = --clusters.active;
  if (b == last) return;
  for (std::size_t other = 0; other < last; ++other) {
    sums[b * stride + other] = sums[last * stride + other];
    sums[other * stride + b] = sums[last * stride + other];
  }
  clusters.slots[b] = clusters.slots[last];
}

}  // namespace

template <typename Sum>
bool average_linkage(Sum* sums, int count, LinkageWorkspace& workspace, Merge* merges,
                     bool (*stop)(const void*), const void* stop_argument) {
  const auto n = static_cast<std::size_t>(count);
  workspace.slots.resize(n);
  for (std::size_t i = 0; i < n; ++i) workspace.slots[i] = {static_cast<std::uint32_t>(i), 1};
  // The chain holds slots; each is the nearest of the one before, and pairs come ever closer along it.
  std::vector<std::uint32_t>& chain = workspace.chain;
  chain.clear();
  Clusters<Sum> clusters{sums, n, workspace.slots.data(), n};

  while (clusters.active > 1) {
    if (stop != nullptr && stop(stop_argument)) return false;
    if (chain.empty()) chain.push_back(0);
    const std::size_t top = chain.back();
    const std::size_t next = nearest(clusters, top);
    if (chain.size() < 2 || chain[chain.size() - 2] != next) {
      chain.push_back(static_cast<std::uint32_t>(next));
      continue;
    }
    // Each is the other's nearest: no later merge can come between them, because mean distances never shrink
    // below the smaller of their parts (average linkage is reducible), and names never fall below the smaller
    // either.
    chain.resize(chain.size() - 2);
    *merges++ = merged(clusters, top, next);
    const std::size_t last = clusters.active - 1;
    const std::size_t kept = top == last ? next : top;  // so that the joined cluster does not move
    const std::size_t freed = kept == top ? next : top;
    join(clusters, kept, freed);
    for (std::uint32_t& slot : chain)
      if (slot == last) slot = static_cast<std::uint32_t>(freed);
  }
  return true;
}

template bool average_linkage<std::uint32_t>(std::uint32_t*, int, LinkageWorkspace&, Merge*,
                                             bool (*)(const void*), const void*);
template bool average_linkage<std::uint64_t>(std::uint64_t*, int, LinkageWorkspace&, Merge*,
                                             bool (*)(const void*), const void*);

}  // namespace keenline::kernels
