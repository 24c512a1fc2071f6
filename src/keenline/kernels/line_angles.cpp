#include "keenline/kernels/line_angles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "keenline/kernels/average_linkage.h"
#include "keenline/kernels/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "keenline/kernels/line_angles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Compiled once for every target.
HWY_BEFORE_NAMESPACE();
namespace keenline::kernels::HWY_NAMESPACE {
namespace {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
// Never called, see target_is_scalar().
void all_angles(const Lines& /*lines*/, std::uint32_t* /*angles*/) {}
float smallest_cosine(const Lines& /*lines*/, float /*x*/, float /*y*/, float /*z*/) { return 1; }
#else
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Float = hn::Vec<Floats>;
using Int = hn::Vec<Ints>;

struct Line {
  Float x, y, z;
};

/// As many lines as a vector has lanes, from line i on.
HWY_INLINE Line lines_at(const Lines& lines, std::size_t i) {
  const Floats d;
  return {hn::LoadU(d, lines.x + i), hn::LoadU(d, lines.y + i), hn::LoadU(d, lines.z + i)};
}

/// One line in all lanes.
HWY_INLINE Line everywhere(float x, float y, float z) {
  const Floats d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

HWY_INLINE Float cosines(const Line& a, const Line& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// line_angle() in every lane.
HWY_INLINE Int angles_of(Float cosines) {
  const Floats d;
  const Ints di;
  const Float c = hn::Min(hn::Abs(cosines), hn::Set(d, 1.0F));
  Float p = hn::Set(d, arc_cosine_polynomial[0]);
  for (std::size_t i = 1; i < arc_cosine_polynomial.size(); ++i)
    p = hn::Add(hn::Mul(p, c), hn::Set(d, arc_cosine_polynomial[i]));
  const Float root = hn::Sqrt(hn::Sub(hn::Set(d, 1.0F), c));
  const Int rounded = hn::BitCast(di, hn::Add(hn::Mul(root, p), hn::Set(d, whole_number_offset)));
  return hn::Sub(rounded, hn::Set(di, std::bit_cast<std::int32_t>(whole_number_offset)));
}

/// Four rows of as many numbers as a vector has: column by column, those of column 4 b + r at
/// columns[r * lanes + 4 b].
HWY_INLINE void transpose(const Int* rows, std::int32_t* columns) {
  const Ints d;
  const hn::RepartitionToWide<Ints> pairs;
  const std::size_t lanes = hn::Lanes(d);
  const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, rows[0], rows[1]));
  const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, rows[2], rows[3]));
  const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, rows[0], rows[1]));
  const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, rows[2], rows[3]));
  hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)), d, columns);
  hn::Store(hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)), d, columns + lanes);
  hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)), d, columns + 2 * lanes);
  hn::Store(hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23)), d, columns + 3 * lanes);
}

/// Angles of four lines i … i + 3 to a vector of lines that begins at j, on both sides of the diagonal.
HWY_INLINE void tile(const Lines& padded, std::size_t i, std::size_t j, std::size_t stride,
                     std::int32_t* angles) {
  const Ints d;
  const std::size_t lanes = hn::Lanes(d);
  const auto count = static_cast<std::size_t>(padded.count);
  const Line others = lines_at(padded, j);
  Int rows[4];
  for (std::size_t r = 0; r < 4; ++r) {
    rows[r] = angles_of(cosines(everywhere(padded.x[i + r], padded.y[i + r], padded.z[i + r]), others));
    if (i + r < count) hn::StoreU(rows[r], d, angles + (i + r) * stride + j);
  }
  HWY_ALIGN std::int32_t columns[4 * 16];
  transpose(rows, columns);
  for (std::size_t c = 0; c < std::min(lanes, count - j); ++c)
    std::memcpy(angles + (j + c) * stride + i, columns + c % 4 * lanes + c / 4 * 4, 4 * sizeof(std::int32_t));
}

/// \pre lines.count <= largest_count_in_32_bits
void all_angles(const Lines& lines, std::uint32_t* angles) {
  // Copies that whole vectors can be read from.
  constexpr std::size_t room = row_length(largest_count_in_32_bits);
  HWY_ALIGN float x[room];
  HWY_ALIGN float y[room];
  HWY_ALIGN float z[room];
  const auto count = static_cast<std::size_t>(lines.count);
  const std::size_t stride = row_length(lines.count);
  for (std::size_t i = 0; i < stride; ++i) {
    x[i] = i < count ? lines.x[i] : 0;
    y[i] = i < count ? lines.y[i] : 0;
    z[i] = i < count ? lines.z[i] : 0;
  }
  const Lines padded{x, y, z, lines.count};
  auto* const out = reinterpret_cast<std::int32_t*>(angles);
  const std::size_t lanes = hn::Lanes(Ints());
  // From the diagonal on, not from where a vector begins; the last one ends with the row.
  for (std::size_t i = 0; i < count; i += 4)
    for (std::size_t j = i; j < count; j += lanes) tile(padded, i, std::min(j, stride - lanes), stride, out);
  for (std::size_t i = 0; i < count; ++i) out[i * stride + i] = 0;
}

float smallest_cosine(const Lines& lines, float x, float y, float z) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  const auto count = static_cast<std::size_t>(lines.count);
  const Line line = everywhere(x, y, z);
  Float smallest = hn::Set(d, 1.0F);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    smallest = hn::Min(smallest, hn::Abs(cosines(line, lines_at(lines, i))));
  float result = hn::GetLane(hn::MinOfLanes(d, smallest));
  for (; i < count; ++i)
    result = std::min(result, std::abs(x * lines.x[i] + y * lines.y[i] + z * lines.z[i]));
  return result;
}

#endif

}  // namespace
}  // namespace keenline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keenline::kernels {
namespace {

HWY_EXPORT(all_angles);
HWY_EXPORT(smallest_cosine);

float cosine(const Lines& lines, std::size_t i, std::size_t j) {
  return lines.x[i] * lines.x[j] + lines.y[i] * lines.y[j] + lines.z[i] * lines.z[j];
}

}  // namespace

std::uint32_t line_angle(float cosine) {
  const float c = std::min(std::abs(cosine), 1.0F);
  float p = arc_cosine_polynomial[0];
  for (std::size_t i = 1; i < arc_cosine_polynomial.size(); ++i) p = p * c + arc_cosine_polynomial[i];
  const float rounded = std::sqrt(1.0F - c) * p + whole_number_offset;
  return std::bit_cast<std::uint32_t>(rounded) - std::bit_cast<std::uint32_t>(whole_number_offset);
}

template <typename Sum>
void line_angles(const Lines& lines, Sum* angles) {
  if constexpr (sizeof(Sum) == 4) {
    if (!target_is_scalar() && lines.count <= largest_count_in_32_bits)
      return HWY_DYNAMIC_DISPATCH(all_angles)(lines, angles);
  }
  const auto n = static_cast<std::size_t>(lines.count);
  const std::size_t stride = row_length(lines.count);
  for (std::size_t i = 0; i < n; ++i) {
    angles[i * stride + i] = 0;
    for (std::size_t j = i + 1; j < n; ++j) {
      const Sum angle = line_angle(cosine(lines, i, j));
      angles[i * stride + j] = angle;
      angles[j * stride + i] = angle;
    }
  }
}

template void line_angles<std::uint32_t>(const Lines&, std::uint32_t*);
template void line_angles<std::uint64_t>(const Lines&, std::uint64_t*);

float smallest_cosine_to(const Lines& lines, float x, float y, float z) {
  if (!target_is_scalar()) return HWY_DYNAMIC_DISPATCH(smallest_cosine)(lines, x, y, z);
  float smallest = 1.0F;
  for (int i = 0; i < lines.count; ++i)
    smallest = std::min(smallest, std::abs(x * lines.x[i] + y * lines.y[i] + z * lines.z[i]));
  return smallest;
}

bool all_within(const Lines& lines, double units) {
  // Angles between lines obey the triangle inequality: half the distance to one of them is enough for all.
  // One unit less for what two roundings can add up to.
  if (lines.count < 2) return true;
  const Lines others{lines.x + 1, lines.y + 1, lines.z + 1, lines.count - 1};
  const float smallest = smallest_cosine_to(others, lines.x[0], lines.y[0], lines.z[0]);
  return 2.0 * (line_angle(smallest) + 1.0) <= units;
}

}  // namespace keenline::kernels
#endif
