#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace keenline::kernels {

/// One step of agglomerative clustering: two clusters become one.
struct Merge {
  std::uint32_t first;        ///< smallest item of the one cluster; the merged cluster keeps this name
  std::uint32_t second;       ///< smallest item of the other, > first
  std::uint32_t first_size;   ///< items in the one …
  std::uint32_t second_size;  ///< … and in the other
  double height;              ///< mean distance between items of the one and items of the other
};

/// Room for a clustering, kept between calls.
struct LinkageWorkspace {
  struct Slot {
    std::uint32_t name;  // smallest item of the cluster
    std::uint32_t size;
  };
  struct alignas(32) Cluster {   // a power of two: found without a product
    std::uint32_t size;          // 0 once it has been merged into another
    std::uint32_t birth, seen;   // number of the merge that made it, and of the last that its row knows of
    std::uint32_t older, newer;  // clusters made of others, in order of their births
    std::uint32_t nearest, nearest_size;  // as found; out of date when that has another size
  };
  std::vector<Slot> slots;
  // Of the vector targets, by name of the cluster.
  std::vector<Cluster> clusters;
  std::vector<float> weights;
  std::vector<std::uint32_t> names;
};

/// Average-linkage clustering of `count` items, exact in whole numbers.
/// Always merges the closest pair of clusters; equal distances in the order of (smaller name, larger name).
/// The pairs are found by going from each cluster to its nearest, first from item 0, until two are each
/// other's nearest, and on from what they become: about 3 count searches of a row. So merges come in another
/// order than by height, but a cluster comes after what it consists of, and no cluster is lower than its
/// parts.
/// \param sums  in: distances between items, sums[i * row_length(count) + j], symmetric, each <= 65520;
///              destroyed. Sum = std::uint32_t holds up to 512 items, std::uint64_t any number.
/// \param rest  clustering ends as soon as one cluster has so many items and less are outside: no merge that
///              is left out makes or takes in another cluster of `rest` items. 1: with all in one
/// \param merges out: as many as returned; room for count - 1
/// \param stop  asked now and then; when it answers true nothing is returned
/// \return the number of merges
/// \pre count >= 1, 1 <= rest
template <typename Sum>
[[nodiscard]] std::optional<int> average_linkage(Sum* sums, int count, int rest, LinkageWorkspace& workspace,
                                                 Merge* merges, bool (*stop)(const void*) = nullptr,
                                                 const void* stop_argument = nullptr);

/// Largest number of items whose sums of distances fit 32 bits: a cluster pair has at most (512 / 2)^2 =
/// 65536 item pairs of at most 65520 units.
inline constexpr int largest_count_in_32_bits = 512;

}  // namespace keenline::kernels
