#include "keenline/kernels/triangle_shapes.h"

#include <algorithm>
#include <array>

#include "keenline/kernels/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "keenline/kernels/triangle_shapes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Compiled once for every target.
HWY_BEFORE_NAMESPACE();
namespace keenline::kernels::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
// Never called, see target_is_scalar().
void shapes_of(const double* /*offsets*/, std::size_t /*count*/, std::uint8_t* /*shapes*/) {}
std::size_t count_from(const std::uint8_t* /*shapes*/, std::size_t /*count*/, std::uint8_t /*least*/) {
  return 0;
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, shape_slack>;
using Float = hn::Vec<Floats>;

/// One array per coordinate, with room for whole vectors.
struct Offsets {
  static constexpr std::size_t room = 255 + shape_slack;
  HWY_ALIGN float x[room];
  HWY_ALIGN float y[room];
  HWY_ALIGN float z[room];
  HWY_ALIGN float square[room];

  Offsets(const double* offsets, std::size_t count) {
    for (std::size_t i = 0; i < count + shape_slack; ++i) {
      const bool given = i < count;
      x[i] = given ? static_cast<float>(offsets[3 * i]) : 0;
      y[i] = given ? static_cast<float>(offsets[3 * i + 1]) : 0;
      z[i] = given ? static_cast<float>(offsets[3 * i + 2]) : 0;
      square[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    }
  }
};

HWY_INLINE Float sum_of_products(Float ax, Float ay, Float az, Float bx, Float by, Float bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

void shapes_of(const double* offsets, std::size_t count, std::uint8_t* shapes) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> di;
  const hn::Rebind<std::uint8_t, Floats> d8;
  const std::size_t lanes = hn::Lanes(d);
  const Offsets a(offsets, count);
  for (std::size_t i = 0; i < count; shapes += count - ++i) {
    const Float x = hn::Set(d, a.x[i]);
    const Float y = hn::Set(d, a.y[i]);
    const Float z = hn::Set(d, a.z[i]);
    const Float square = hn::Set(d, a.square[i]);
    for (std::size_t j = i + 1; j < count; j += lanes) {
      const Float bx = hn::LoadU(d, a.x + j);
      const Float by = hn::LoadU(d, a.y + j);
      const Float bz = hn::LoadU(d, a.z + j);
      const Float nx = hn::Sub(hn::Mul(y, bz), hn::Mul(z, by));
      const Float ny = hn::Sub(hn::Mul(z, bx), hn::Mul(x, bz));
      const Float nz = hn::Sub(hn::Mul(x, by), hn::Mul(y, bx));
      const Float sides =
          hn::Sub(hn::Add(square, hn::LoadU(d, a.square + j)), sum_of_products(x, y, z, bx, by, bz));
      const Float areas = hn::Mul(hn::Set(d, 768.0F), sum_of_products(nx, ny, nz, nx, ny, nz));
      const Float shape = hn::Div(areas, hn::Max(hn::Mul(sides, sides), hn::Set(d, least_square)));
      const auto whole = hn::ConvertTo(di, hn::Min(shape, hn::Set(d, 255.0F)));
      hn::StoreU(hn::DemoteTo(d8, whole), d8, shapes + (j - i - 1));
    }
  }
}

std::size_t count_from(const std::uint8_t* shapes, std::size_t count, std::uint8_t least) {
  const hn::CappedTag<std::uint8_t, 32> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto wanted = hn::Set(d, least);
  std::size_t found = 0;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto shape = hn::LoadU(d, shapes + i);
    found += hn::CountTrue(d, hn::Eq(hn::Max(shape, wanted), shape));
  }
  for (; i < count; ++i) found += shapes[i] >= least ? 1U : 0U;
  return found;
}

#endif

}  // namespace
}  // namespace keenline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keenline::kernels {
namespace {

HWY_EXPORT(shapes_of);
HWY_EXPORT(count_from);

/// See triangle_shapes().
std::uint8_t shape_of(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const auto dot = [](const std::array<float, 3>& u, const std::array<float, 3>& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const std::array<float, 3> normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                    a[0] * b[1] - a[1] * b[0]};
  // The squares of the sides add up to twice this, and four times the area is twice the length of the normal.
  const float sides = dot(a, a) + dot(b, b) - dot(a, b);
  const float shape = 768.0F * dot(normal, normal) / std::max(sides * sides, least_square);
  return static_cast<std::uint8_t>(std::min(shape, 255.0F));
}

}  // namespace

void triangle_shapes(const double* offsets, int count, std::uint8_t* shapes) {
  const auto n = static_cast<std::size_t>(count);
  if (!target_is_scalar()) return HWY_DYNAMIC_DISPATCH(shapes_of)(offsets, n, shapes);
  const auto offset = [&](std::size_t i) {
    return std::array{static_cast<float>(offsets[3 * i]), static_cast<float>(offsets[3 * i + 1]),
                      static_cast<float>(offsets[3 * i + 2])};
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) *shapes++ = shape_of(offset(i), offset(j));
}

std::uint8_t shape_of_best(const std::uint8_t* shapes, std::size_t count, std::size_t best) {
  const auto count_at_least = [&](std::uint8_t least) {
    if (!target_is_scalar()) return HWY_DYNAMIC_DISPATCH(count_from)(shapes, count, least);
    return static_cast<std::size_t>(
        std::count_if(shapes, shapes + count, [&](std::uint8_t shape) { return shape >= least; }));
  };
  unsigned shape = 0;
  for (unsigned bit = 128; bit > 0; bit /= 2)
    if (count_at_least(static_cast<std::uint8_t>(shape | bit)) >= best) shape |= bit;
  return static_cast<std::uint8_t>(shape);
}

}  // namespace keenline::kernels
#endif
