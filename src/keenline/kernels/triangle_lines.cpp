#include "keenline/kernels/triangle_lines.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "keenline/kernels/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "keenline/kernels/triangle_lines.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Compiled once for every target.
HWY_BEFORE_NAMESPACE();
namespace keenline::kernels::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
// Never called, see target_is_scalar().
int lines_of(const double* /*offsets*/, const double* /*lengths*/, int /*count*/, double /*min_sine*/,
             float* /*x*/, float* /*y*/, float* /*z*/) {
  return 0;
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, line_slack>;
using Double = hn::Vec<Doubles>;

/// One array per coordinate, filled up with zeros, which have no normal and so make no lines.
struct Offsets {
  static constexpr std::size_t room = 255 + line_slack;
  HWY_ALIGN double x[room];
  HWY_ALIGN double y[room];
  HWY_ALIGN double z[room];
  HWY_ALIGN double length[room];

  Offsets(const double* offsets, const double* lengths, std::size_t count) {
    for (std::size_t i = 0; i < count + line_slack; ++i) {
      const bool given = i < count;
      x[i] = given ? offsets[3 * i] : 0;
      y[i] = given ? offsets[3 * i + 1] : 0;
      z[i] = given ? offsets[3 * i + 2] : 0;
      length[i] = given ? lengths[i] : 0;
    }
  }
};

/// Where lines are appended.
struct Output {
  float* x;
  float* y;
  float* z;
  int count = 0;

  HWY_INLINE void append(Double nx, Double ny, Double nz, std::uint64_t kept) {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    if ((kept & (kept + 1)) == 0) {  // the first few, nearly always: what is written beyond is written over
      hn::StoreU(hn::DemoteTo(df, nx), df, x + count);
      hn::StoreU(hn::DemoteTo(df, ny), df, y + count);
      hn::StoreU(hn::DemoteTo(df, nz), df, z + count);
      count += std::popcount(kept);
      return;
    }
    HWY_ALIGN double lanes[3][line_slack];
    hn::Store(nx, d, lanes[0]);
    hn::Store(ny, d, lanes[1]);
    hn::Store(nz, d, lanes[2]);
    for (; kept != 0; kept &= kept - 1, ++count) {
      const int lane = std::countr_zero(kept);
      x[count] = static_cast<float>(lanes[0][lane]);
      y[count] = static_cast<float>(lanes[1][lane]);
      z[count] = static_cast<float>(lanes[2][lane]);
    }
  }
};

/// The lines of a triangle's corner i with a vector of corners that begins at j.
HWY_INLINE void append_lines(const Offsets& offsets, std::size_t i, std::size_t j, double min_sine,
                             Output& lines) {
  const Doubles d;
  const Double ax = hn::Set(d, offsets.x[i]);
  const Double ay = hn::Set(d, offsets.y[i]);
  const Double az = hn::Set(d, offsets.z[i]);
  const Double bx = hn::LoadU(d, offsets.x + j);
  const Double by = hn::LoadU(d, offsets.y + j);
  const Double bz = hn::LoadU(d, offsets.z + j);
  const Double nx = hn::Sub(hn::Mul(ay, bz), hn::Mul(az, by));
  const Double ny = hn::Sub(hn::Mul(az, bx), hn::Mul(ax, bz));
  const Double nz = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
  const Double length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
  const Double products = hn::Mul(hn::Set(d, offsets.length[i]), hn::LoadU(d, offsets.length + j));
  const auto kept =
      hn::And(hn::Gt(length, hn::Zero(d)), hn::Ge(length, hn::Mul(hn::Set(d, min_sine), products)));
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, kept, reinterpret_cast<std::uint8_t*>(&bits));
  lines.append(hn::Div(nx, length), hn::Div(ny, length), hn::Div(nz, length), bits);
}

int lines_of(const double* offsets, const double* lengths, int count, double min_sine, float* x, float* y,
             float* z) {
  const auto n = static_cast<std::size_t>(count);
  const Offsets padded(offsets, lengths, n);
  Output lines{x, y, z};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; j += hn::Lanes(Doubles())) append_lines(padded, i, j, min_sine, lines);
  return lines.count;
}

#endif

}  // namespace
}  // namespace keenline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keenline::kernels {
namespace {

HWY_EXPORT(lines_of);

}  // namespace

int triangle_lines(const double* offsets, const double* lengths, int count, double min_sine, float* x,
                   float* y, float* z) {
  if (!target_is_scalar()) return HWY_DYNAMIC_DISPATCH(lines_of)(offsets, lengths, count, min_sine, x, y, z);
  int lines = 0;
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double* const a = offsets + 3 * i;
      const double* const b = offsets + 3 * j;
      const double nx = a[1] * b[2] - a[2] * b[1];
      const double ny = a[2] * b[0] - a[0] * b[2];
      const double nz = a[0] * b[1] - a[1] * b[0];
      const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
      if (!(length > 0) || length < min_sine * (lengths[i] * lengths[j])) continue;
      x[lines] = static_cast<float>(nx / length);
      y[lines] = static_cast<float>(ny / length);
      z[lines] = static_cast<float>(nz / length);
      ++lines;
    }
  }
  return lines;
}

}  // namespace keenline::kernels
#endif
