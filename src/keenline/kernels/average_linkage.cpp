#include "keenline/kernels/average_linkage.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "keenline/kernels/line_angles.h"
#include "keenline/kernels/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "keenline/kernels/average_linkage.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Compiled once for every target.
HWY_BEFORE_NAMESPACE();
namespace keenline::kernels::HWY_NAMESPACE {
namespace {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
// Never called, see target_is_scalar().
int cluster(std::uint32_t* /*sums*/, int /*count*/, std::uint32_t /*enough*/, LinkageWorkspace& /*workspace*/,
            Merge* /*merges*/) {
  return 0;
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, 8>;
using Ints = hn::RebindToSigned<Words>;
using Floats = hn::RebindToFloat<Words>;
using Word = hn::Vec<Words>;

constexpr std::uint32_t none = 0xFFFF'FFFFU;

/// A sum that no cluster has.
constexpr std::uint32_t self = 0x8000'0000U;

/// Matrices of more columns leave the first cache.
constexpr std::size_t most_columns_written_at_once = 80;

/// Clusters by name. Rows and columns of clusters that were merged into others stay where they are, and no
/// more is read there. The rows of large matrices are brought up to date when they are read: writing every
/// merged cluster into its column at once would touch a line of the cache for every number. Where they all
/// are in the first cache, that is the faster way.
struct Clusters {
  std::uint32_t* sums;
  std::size_t stride;
  std::size_t rows;
  std::size_t columns;  // whole pairs of vectors
  LinkageWorkspace::Cluster* clusters;
  float* weights;  // 1 / size; not a number for those that were merged into others, and beyond the last
  const std::uint32_t* names;  // 0, 1, 2 …
  std::uint32_t index_mask;
  std::uint32_t newest = none;  // of those made of others

  [[nodiscard]] bool are_written_at_once() const { return columns <= most_columns_written_at_once; }
  [[nodiscard]] std::uint32_t* row(std::size_t name) const { return sums + name * stride; }
  [[nodiscard]] LinkageWorkspace::Cluster& operator[](std::size_t name) const { return clusters[name]; }
};

/// The row of a cluster, with what has become of the others since it was last looked at.
HWY_INLINE std::uint32_t* current_row(const Clusters& clusters, std::size_t name) {
  auto& cluster = clusters[name];
  std::uint32_t* const row = clusters.row(name);
  if (clusters.are_written_at_once()) return row;
  row[name] = self;
  std::uint32_t other = clusters.newest;
  for (; other != none && clusters[other].birth > cluster.seen; other = clusters[other].older)
    row[other] = clusters.row(other)[name];
  cluster.seen = clusters.newest == none ? 0 : clusters[clusters.newest].birth;
  return row;
}

/// Means, but for the size of the row's own cluster, as the bits of floats. Those that are not to be found
/// are negative (a cluster and itself) or not numbers: as unsigned numbers greater than every positive float.
HWY_INLINE Word keys_of(Word sums, const float* weights) {
  const Floats df;
  const auto means = hn::Mul(hn::ConvertTo(df, hn::BitCast(Ints(), sums)), hn::LoadU(df, weights));
  return hn::BitCast(Words(), means);
}

/// The two smallest keys of a row, whose last bits give way to their names.
class TwoSmallest {
 public:
  explicit TwoSmallest(std::uint32_t index_mask) : mask_(hn::Set(Words(), ~index_mask)) {}

  HWY_INLINE void add(Word keys, const std::uint32_t* names) {
    const Word marked = hn::Or(hn::And(keys, mask_), hn::LoadU(Words(), names));
    second_ = hn::Min(second_, hn::Max(first_, marked));
    first_ = hn::Min(first_, marked);
  }
  [[nodiscard]] HWY_INLINE std::uint32_t first() const {
    return hn::GetLane(hn::MinOfLanes(Words(), first_));
  }
  [[nodiscard]] HWY_INLINE std::uint32_t second(std::uint32_t first) const {
    const Words d;
    const auto holds_first = hn::Eq(first_, hn::Set(d, first));
    return hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(holds_first, second_, first_)));
  }

 private:
  Word mask_;
  Word first_ = hn::Set(Words(), none);
  Word second_ = hn::Set(Words(), none);
};

/// Calls see(0), see(lanes) … for whole pairs of vectors, two pairs at a time as long as there are two.
template <typename See>
HWY_INLINE void for_each_vector(std::size_t columns, const See& see) {
  const std::size_t lanes = hn::Lanes(Words());
  std::size_t i = 0;
  for (; i + 4 * lanes <= columns; i += 4 * lanes) {
    see(i);
    see(i + lanes);
    see(i + 2 * lanes);
    see(i + 3 * lanes);
  }
  for (; i < columns; i += 2 * lanes) {
    see(i);
    see(i + lanes);
  }
}

/// Among those whose keys are at most `bound` the least fraction, compared crosswise in whole numbers, then
/// the least name.
std::uint32_t least_of(const Clusters& clusters, const std::uint32_t* row, std::uint32_t bound) {
  const Words d;
  std::uint32_t best = none;
  for (std::size_t i = 0; i < clusters.columns; i += hn::Lanes(d)) {
    const Word keys = keys_of(hn::LoadU(d, row + i), clusters.weights + i);
    const auto found = hn::Eq(hn::Min(keys, hn::Set(d, bound)), keys);
    if (hn::AllFalse(d, found)) continue;
    std::uint64_t bits = 0;
    hn::StoreMaskBits(d, found, reinterpret_cast<std::uint8_t*>(&bits));
    for (; bits != 0; bits &= bits - 1) {
      const auto other = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(bits));
      if (best == none ||
          std::uint64_t{row[other]} * clusters[best].size < std::uint64_t{row[best]} * clusters[other].size)
        best = other;
    }
  }
  return best;
}

/// The cluster nearest to the one whose row this is: least mean distance, then least name. Two roundings of a
/// sum and one of a weight put a key off its mean by a few units in the last place. Those that were cut off
/// are more: where the rest of two keys differs by more than one, so do the means, and in the same sense.
HWY_INLINE std::uint32_t nearest_by(const Clusters& clusters, const std::uint32_t* row,
                                    const TwoSmallest& smallest) {
  const std::uint32_t first = smallest.first();
  const std::uint32_t second = smallest.second(first);
  const std::uint32_t index_mask = clusters.index_mask;
  const std::uint32_t bound = (first | index_mask) + index_mask + 1;
  // Sums of 0 are exact, and the first of them has the least name.
  if (HWY_LIKELY(second > bound || first <= index_mask)) return first & index_mask;
  return least_of(clusters, row, bound);
}

HWY_INLINE std::uint32_t nearest(const Clusters& clusters, std::size_t name) {
  const Words d;
  const std::uint32_t* const row = current_row(clusters, name);
  TwoSmallest smallest(clusters.index_mask);
  const auto look = [&](std::size_t i) HWY_ATTR {
    smallest.add(keys_of(hn::LoadU(d, row + i), clusters.weights + i), clusters.names + i);
  };
  for_each_vector(clusters.columns, look);
  return nearest_by(clusters, row, smallest);
}

/// Brings the other rows up to date with that of a merged cluster.
HWY_INLINE void write_column(const Clusters& clusters, std::size_t name) {
  std::uint32_t* const row = clusters.row(name);
  row[name] = self;
  for (std::size_t other = 0; other < clusters.rows; ++other) clusters.row(other)[name] = row[other];
}

/// Takes a cluster off the list of those made of others.
HWY_INLINE void retire(Clusters& clusters, const LinkageWorkspace::Cluster& cluster) {
  if (cluster.birth == 0) return;
  if (cluster.older != none) clusters[cluster.older].newer = cluster.newer;
  (cluster.newer != none ? clusters[cluster.newer].older : clusters.newest) = cluster.older;
}

/// Puts it at the head of that list.
HWY_INLINE void enlist(Clusters& clusters, std::uint32_t name, std::uint32_t number) {
  auto& cluster = clusters[name];
  if (clusters.newest != none) clusters[clusters.newest].newer = name;
  cluster.older = clusters.newest;
  cluster.newer = none;
  cluster.birth = cluster.seen = number;
  clusters.newest = name;
}

/// Puts the items of b into a < b; merges are numbered from 1.
HWY_INLINE Merge join(Clusters& clusters, std::uint32_t a, std::uint32_t b, std::uint32_t number) {
  auto& first = clusters[a];
  auto& second = clusters[b];
  std::uint32_t* const row = current_row(clusters, a);
  const std::uint32_t* const added = current_row(clusters, b);
  const double pairs = static_cast<double>(first.size) * second.size;
  const Merge merge{a, b, first.size, second.size, static_cast<double>(row[b]) / pairs};
  if (!clusters.are_written_at_once()) {
    retire(clusters, first);
    retire(clusters, second);
    enlist(clusters, a, number);
  }
  first.size += second.size;
  second.size = 0;
  clusters.weights[a] = 1.0F / static_cast<float>(first.size);
  clusters.weights[b] = std::numeric_limits<float>::quiet_NaN();

  const Words d;
  TwoSmallest smallest(clusters.index_mask);
  const auto add = [&](std::size_t i) HWY_ATTR {
    const Word sums = hn::Add(hn::LoadU(d, row + i), hn::LoadU(d, added + i));
    hn::StoreU(sums, d, row + i);
    smallest.add(keys_of(sums, clusters.weights + i), clusters.names + i);
  };
  for_each_vector(clusters.columns, add);
  if (clusters.are_written_at_once()) write_column(clusters, a);
  first.nearest = nearest_by(clusters, row, smallest);
  first.nearest_size = clusters[first.nearest].size;
  return merge;
}

Clusters prepared(std::uint32_t* sums, int count, LinkageWorkspace& workspace) {
  const auto n = static_cast<std::size_t>(count);
  const std::size_t lanes = 2 * hn::Lanes(Words());
  const std::size_t columns = (n + lanes - 1) / lanes * lanes;
  workspace.clusters.assign(
      columns,
      {.size = 1, .birth = 0, .seen = 0, .older = none, .newer = none, .nearest = 0, .nearest_size = 0});
  workspace.weights.assign(columns, std::numeric_limits<float>::quiet_NaN());
  std::fill_n(workspace.weights.begin(), n, 1.0F);
  if (workspace.names.size() < columns) {
    workspace.names.resize(columns);
    std::iota(workspace.names.begin(), workspace.names.end(), 0U);
  }
  return {sums,
          row_length(count),
          n,
          columns,
          workspace.clusters.data(),
          workspace.weights.data(),
          workspace.names.data(),
          static_cast<std::uint32_t>(std::bit_ceil(columns) - 1)};
}

/// \pre 0 < count <= largest_count_of_vectors
int cluster(std::uint32_t* sums, int count, std::uint32_t enough, LinkageWorkspace& workspace,
            Merge* merges) {
  Clusters clusters = prepared(sums, count, workspace);
  if (clusters.are_written_at_once())
    for (std::size_t name = 0; name < clusters.rows; ++name) clusters.row(name)[name] = self;
  const Merge* const first_merge = merges;
  std::uint32_t before = none;
  for (std::uint32_t top = 0, number = 1; clusters[top].size < enough;) {
    auto& cluster = clusters[top];
    // The nearest stays the nearest until it is merged itself, see average_linkage().
    if (cluster.nearest_size == 0 || clusters[cluster.nearest].size != cluster.nearest_size) {
      cluster.nearest = nearest(clusters, top);
      cluster.nearest_size = clusters[cluster.nearest].size;
    }
    const std::uint32_t next = cluster.nearest;
    if (next != before) {
      before = top;
      top = next;
      continue;
    }
    *merges++ = join(clusters, std::min(top, next), std::max(top, next), number++);
    top = std::min(top, next);
    before = none;
  }
  return static_cast<int>(merges - first_merge);
}

#endif

}  // namespace
}  // namespace keenline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keenline::kernels {
namespace {

HWY_EXPORT(cluster);

/// Sums of so many items fit signed numbers: (362 / 2)^2 pairs of at most 65520 units.
constexpr int largest_count_of_vectors = 362;

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

/// Puts b's items into a, and the last active cluster where b was. \pre a < b
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
std::optional<int> average_linkage(Sum* sums, int count, int rest, LinkageWorkspace& workspace, Merge* merges,
                                   bool (*stop)(const void*), const void* stop_argument) {
  const auto enough = static_cast<std::uint32_t>(std::min(std::max(count - rest + 1, rest), count));
  if constexpr (sizeof(Sum) == 4) {
    if (!target_is_scalar() && count <= largest_count_of_vectors) {
      // Once: it takes less than a millisecond.
      if (stop != nullptr && stop(stop_argument)) return std::nullopt;
      return HWY_DYNAMIC_DISPATCH(cluster)(sums, count, enough, workspace, merges);
    }
  }
  const auto n = static_cast<std::size_t>(count);
  workspace.slots.resize(n);
  for (std::size_t i = 0; i < n; ++i) workspace.slots[i] = {static_cast<std::uint32_t>(i), 1};
  Clusters<Sum> clusters{sums, row_length(count), workspace.slots.data(), n};

  std::size_t before = n;  // none
  const Merge* const first_merge = merges;
  for (std::size_t top = 0; clusters.slots[top].size < enough;) {
    if (stop != nullptr && stop(stop_argument)) return std::nullopt;
    const std::size_t next = nearest(clusters, top);
    if (next != before) {
      before = top;
      top = next;
      continue;
    }
    // Each is the other's nearest: no later merge can come between them, because mean distances never shrink
    // below the smaller of their parts (average linkage is reducible), and names never fall below the smaller
    // either.
    *merges++ = merged(clusters, top, next);
    join(clusters, std::min(top, next), std::max(top, next));
    top = std::min(top, next);
    before = n;
  }
  return static_cast<int>(merges - first_merge);
}

template std::optional<int> average_linkage<std::uint32_t>(std::uint32_t*, int, int, LinkageWorkspace&,
                                                           Merge*, bool (*)(const void*), const void*);
template std::optional<int> average_linkage<std::uint64_t>(std::uint64_t*, int, int, LinkageWorkspace&,
                                                           Merge*, bool (*)(const void*), const void*);

}  // namespace keenline::kernels
#endif
