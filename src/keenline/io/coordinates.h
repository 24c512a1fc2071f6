#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "keenline/cloud.h"

namespace keenline {

class Progress;

/// The type as which a text's coordinate is to be parsed when its header declares `declared`. Doubles for
/// floats: a text can give more digits than a float holds, and georeferenced files do.
[[nodiscard]] ScalarType parsed_coordinate_type(ScalarType declared);

/// Gives one axis (0, 1, 2) of the positions the values of `column`, and records how they were stored.
/// A column of doubles that a text declares as floats becomes floats where every value is a float in print
/// (with 6 to 17 digits); where one says more than a float holds, all stay doubles, and position_types[axis]
/// says so. Returns the row of the first 64-bit integer that a double does not hold exactly; the axis is then
/// not set. \pre column has cloud.size() rows. \throw Cancelled.
[[nodiscard]] std::optional<std::size_t> set_axis(PointCloud& cloud, std::size_t axis, const Column& column,
                                                  ScalarType declared, const Progress& progress);

/// Value number `i` of a column in decimal, for a message.
[[nodiscard]] std::string number_text(const Column& column, std::size_t i);

/// What a user should know when set_axis() kept doubles where floats were declared.
inline constexpr const char* wide_coordinates_note =
    "coordinates have more digits than the declared 32-bit floats hold: they are kept as doubles";

}  // namespace keenline
