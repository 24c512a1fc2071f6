#include "keenline/io/ply.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/coordinates.h"
#include "keenline/io/faces.h"
#include "keenline/io/ply_body.h"
#include "keenline/io/ply_header.h"
#include "keenline/io/records.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
constexpr std::size_t values_per_check = 65536;

bool lists_vertices(std::string_view element, std::string_view property) {
  return element == "face" && (property == "vertex_indices" || property == "vertex_index");
}

/// What the header alone can tell is wrong, before any row is read.
void require_points(const Source& source, const PlyHeader& header) {
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end())
    throw InputError(source.name, Place::line(header.lines), "a header without element 'vertex'", "one");
  for (const std::string_view axis : axes) {
    const PlyProperty* const property = vertex->property(axis);
    if (property == nullptr) {
      throw InputError(source.name, Place::line(vertex->line),
                       fmt::format("element 'vertex' without property {}", quoted(axis)), "x, y and z");
    }
    if (property->count_type) {
      throw InputError(source.name, Place::line(property->line), fmt::format("{} as a list", quoted(axis)),
                       "a number");
    }
  }
  if (vertex->count > max_points) {
    throw InputError(source.name, Place::line(vertex->line), fmt::format("{} vertices", vertex->count),
                     fmt::format("at most {}", max_points));
  }
  for (const PlyElement& element : header.elements) {
    for (const PlyProperty& property : element.properties) {
      if (lists_vertices(element.name, property.name) && property.count_type &&
          (property.type == ScalarType::Float32 || property.type == ScalarType::Float64)) {
        throw InputError(source.name, Place::line(property.line), "vertex numbers of a floating-point type",
                         "an integer type");
      }
    }
  }
}

/// The declared types of x, y and z, which in an ascii file are then set to those that they are parsed as.
/// \pre require_points()
std::array<ScalarType, 3> take_coordinate_types(PlyHeader& header) {
  std::array<ScalarType, 3> declared{};
  for (PlyElement& element : header.elements) {
    if (element.name != "vertex") continue;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto property = std::find_if(element.properties.begin(), element.properties.end(),
                                         [&](const PlyProperty& p) { return p.name == axes[d]; });
      declared[d] = property->type;
      if (header.encoding == PlyEncoding::Ascii) property->type = parsed_coordinate_type(declared[d]);
    }
  }
  return declared;
}

class CloudBuilder {
 public:
  CloudBuilder(const Source& source, const PlyBody& body, Progress& progress)
      : source_(source), body_(body), progress_(progress) {}

  /// Moves the columns x, y, z into the positions; the others become attributes. `declared`: the types of x,
  /// y and z in the header.
  void take_vertices(PlyRows& rows, const std::array<ScalarType, 3>& declared) {
    cloud.positions.resize(rows.table.rows);
    for (std::size_t d = 0; d < 3; ++d) {
      const auto column = std::find_if(rows.table.columns.begin(), rows.table.columns.end(),
                                       [&](const Column& c) { return c.name() == axes[d]; });
      if (const auto inexact = set_axis(cloud, d, *column, declared[d], progress_)) {
        throw InputError(source_.name, body_.place_of(rows, *inexact),
                         fmt::format("{} = {}", column->name(), number_text(*column, *inexact)),
                         "a number that a double holds exactly");
      }
    }
    for (Column& column : rows.table.columns) {
      if (std::find(axes.begin(), axes.end(), column.name()) == axes.end())
        cloud.attributes.push_back(std::move(column));
    }
    rows.table.columns.clear();
  }

  void take_table(PlyRows& rows) {
    for (const Column& column : rows.table.columns) {
      if (lists_vertices(rows.table.name, column.name()) && column.is_list())
        require_vertex_numbers(rows, column);
    }
    cloud.tables.push_back(std::move(rows.table));
  }

  PointCloud cloud;

 private:
  void require_vertex_numbers(const PlyRows& rows, const Column& column) const {
    visit_type(column.type(), [&](auto zero) {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T>) {
        const auto values = column.values<T>();
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (i % values_per_check == 0) progress_.check();
          // A negative number becomes larger than any.
          if (static_cast<std::uint64_t>(values[i]) < cloud.size()) continue;
          const auto offsets = column.offsets();
          const auto row = std::upper_bound(offsets.begin(), offsets.end(), i) - offsets.begin() - 1;
          throw InputError(source_.name, body_.place_of(rows, static_cast<std::uint64_t>(row)),
                           fmt::format("vertex number {} in face {}", values[i], row),
                           expected_vertex_number(0, cloud.size()));
        }
      }
    });
  }

  const Source& source_;
  const PlyBody& body_;
  Progress& progress_;
};

}  // namespace

Reading read_ply(const Source& source, Progress& progress) {
  PlyHeader header = read_ply_header(source);
  require_points(source, header);
  const std::array<ScalarType, 3> declared = take_coordinate_types(header);
  PlyBody body(source, header, progress);
  body.require_sizes();
  std::vector<PlyRows> elements;
  for (const PlyElement& element : header.elements) elements.push_back(body.read(element));
  body.expect_end();

  CloudBuilder builder(source, body, progress);
  // Faces may stand before the vertices that they name.
  for (PlyRows& rows : elements)
    if (rows.table.name == "vertex") builder.take_vertices(rows, declared);
  for (PlyRows& rows : elements)
    if (rows.table.name != "vertex") builder.take_table(rows);

  Reading reading;
  reading.cloud = std::move(builder.cloud);
  reading.cloud.comments = std::move(header.comments);
  reading.encoding = name_of(header.encoding);
  if (reading.cloud.position_types != declared) reading.notes.emplace_back(wide_coordinates_note);
  return reading;
}

Format::Match match_ply(const Source& source) {
  std::string_view text = without_bom(source.bytes);
  if (!text.starts_with("ply")) return Format::Match::No;
  text.remove_prefix(3);
  const std::size_t end = text.find_first_not_of(" \t");
  return end == std::string_view::npos || text[end] == '\r' || text[end] == '\n' ? Format::Match::Strong
                                                                                 : Format::Match::No;
}

}  // namespace keenline
