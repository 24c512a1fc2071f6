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
             const std::uint8_t* /*shapes*/, std::uint8_t /*least_shape*/, float* /*x*/, float* /*y*/,
             float* /*z*/) {
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

/// Corners of as many triangles as a vector has lanes, and their distances from the origin.
struct Corners {
  Double x, y, z, length;
};

HWY_INLINE Corners everywhere(const Offsets& offsets, std::size_t i) {
  const Doubles d;
  return {hn::Set(d, offsets.x[i]), hn::Set(d, offsets.y[i]), hn::Set(d, offsets.z[i]),
          hn::Set(d, offsets.length[i])};
}

HWY_INLINE Corners from(const Offsets& offsets, std::size_t j) {
  const Doubles d;
  return {hn::LoadU(d, offsets.x + j), hn::LoadU(d, offsets.y + j), hn::LoadU(d, offsets.z + j),
          hn::LoadU(d, offsets.length + j)};
}

using Indices = hn::Rebind<std::int64_t, Doubles>;

HWY_INLINE Corners chosen(const Offsets& offsets, hn::Vec<Indices> index) {
  const Doubles d;
  return {hn::GatherIndex(d, offsets.x, index), hn::GatherIndex(d, offsets.y, index),
          hn::GatherIndex(d, offsets.z, index), hn::GatherIndex(d, offsets.length, index)};
}

HWY_INLINE void append_lines(const Corners& a, const Corners& b, double min_sine, Output& lines) {
  const Doubles d;
  const Double nx = hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y));
  const Double ny = hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z));
  const Double nz = hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
  const Double length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
  const Double products = hn::Mul(a.length, b.length);
  const auto kept =
      hn::And(hn::Gt(length, hn::Zero(d)), hn::Ge(length, hn::Mul(hn::Set(d, min_sine), products)));
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, kept, reinterpret_cast<std::uint8_t*>(&bits));
  const Double inverse = hn::Div(hn::Set(d, 1.0), length);
  lines.append(hn::Mul(nx, inverse), hn::Mul(ny, inverse), hn::Mul(nz, inverse), bits);
}

/// Triangles, listed by their corners, that are to make lines: those of a few rows at a time.
class Choice {
 public:
  static constexpr std::size_t row = 255;

  /// Without branches: no CPU could guess which are chosen.
  HWY_INLINE void add_row(std::size_t i, std::size_t count, const std::uint8_t* shapes,
                          std::uint8_t least_shape) {
    for (std::size_t j = i + 1; j < count; ++j) {
      corners_[found_] = static_cast<std::int32_t>(i << 8U | j);
      found_ += *shapes++ >= least_shape ? 1U : 0U;
    }
  }
  [[nodiscard]] HWY_INLINE bool has_room_for_row() const { return found_ < row; }

  HWY_INLINE void append_to(Output& lines, const Offsets& offsets, double min_sine) {
    const std::size_t lanes = hn::Lanes(Doubles());
    // A triangle of a corner with itself has no normal.
    for (std::size_t i = found_; i < found_ + lanes; ++i) corners_[i] = 0;
    const Indices d;
    for (std::size_t i = 0; i < found_; i += lanes) {
      const auto corners = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::int32_t, Indices>(), corners_ + i));
      append_lines(chosen(offsets, hn::ShiftRight<8>(corners)),
                   chosen(offsets, hn::And(corners, hn::Set(d, 255))), min_sine, lines);
    }
    found_ = 0;
  }

 private:
  std::int32_t corners_[2 * row + line_slack];  // of each triangle, the first times 256
  std::size_t found_ = 0;
};

/// `shapes`: none if all triangles are to make lines.
int lines_of(const double* offsets, const double* lengths, int count, double min_sine,
             const std::uint8_t* shapes, std::uint8_t least_shape, float* x, float* y, float* z) {
  const auto n = static_cast<std::size_t>(count);
  const Offsets padded(offsets, lengths, n);
  Output lines{x, y, z};
  if (shapes == nullptr) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; j += hn::Lanes(Doubles()))
        append_lines(everywhere(padded, i), from(padded, j), min_sine, lines);
    return lines.count;
  }
  Choice choice;
  for (std::size_t i = 0; i < n; shapes += n - ++i) {
    if (!choice.has_room_for_row()) choice.append_to(lines, padded, min_sine);
    choice.add_row(i, n, shapes, least_shape);
  }
  choice.append_to(lines, padded, min_sine);
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

int triangle_lines(const double* offsets, const double* lengths, int count, double min_sine,
                   const std::uint8_t* shapes, std::uint8_t least_shape, float* x, float* y, float* z) {
  if (!target_is_scalar())
    return HWY_DYNAMIC_DISPATCH(lines_of)(offsets, lengths, count, min_sine, shapes, least_shape, x, y, z);
  int lines = 0;
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (shapes != nullptr && *shapes++ < least_shape) continue;
      const double* const a = offsets + 3 * i;
      const double* const b = offsets + 3 * j;
      const double nx = a[1] * b[2] - a[2] * b[1];
      const double ny = a[2] * b[0] - a[0] * b[2];
      const double nz = a[0] * b[1] - a[1] * b[0];
      const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
      if (!(length > 0) || length < min_sine * (lengths[i] * lengths[j])) continue;
      const double inverse = 1 / length;
      x[lines] = static_cast<float>(nx * inverse);
      y[lines] = static_cast<float>(ny * inverse);
      z[lines] = static_cast<float>(nz * inverse);
      ++lines;
    }
  }
  return lines;
}

int triangle_lines(const double* offsets, const double* lengths, int count, double min_sine, float* x,
                   float* y, float* z) {
  return triangle_lines(offsets, lengths, count, min_sine, nullptr, 0, x, y, z);
}

}  // namespace keenline::kernels
#endif
