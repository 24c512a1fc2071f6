#include "keenline/io/records.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "keenline/progress.h"

namespace keenline {
namespace {

template <typename T>
void unpack_field(const Records& records, const RecordField& field, std::size_t first, std::size_t last) {
  const char* from = records.data + first * records.stride + field.offset;
  std::byte* to = field.target + first * field.values * sizeof(T);
  for (std::size_t i = first; i < last; ++i, from += records.stride) {
    for (std::size_t k = 0; k < field.values; ++k, to += sizeof(T)) {
      const T value = load<T>(from + k * sizeof(T), records.order);
      std::memcpy(to, &value, sizeof(T));
    }
  }
}

}  // namespace

void unpack_records(const Records& records, std::span<const RecordField> fields, Progress& progress) {
  // Blocks that stay in the cache while one field after another is taken from them.
  constexpr std::size_t block_bytes = std::size_t{256} * 1024;
  const std::size_t block = std::max<std::size_t>(1, block_bytes / std::max<std::size_t>(1, records.stride));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, records.count, block),
      [&](const tbb::blocked_range<std::size_t>& rows) {
        progress.check();
        for (const RecordField& field : fields) {
          visit_type(field.type, [&](auto zero) {
            unpack_field<decltype(zero)>(records, field, rows.begin(), rows.end());
          });
        }
        progress.advance(rows.size() * records.stride);
      },
      tbb::simple_partitioner());
}

}  // namespace keenline
