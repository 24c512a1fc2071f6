#include "keenline/io/off.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/io/faces.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_lines.h"
#include "keenline/io/text_rows.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::size_t most_columns = 256;

/// What the header word [ST][C][N][4][n]OFF says of each vertex.
struct Header {
  std::string_view word;
  bool texture = false;
  bool colour = false;
  bool normal = false;
  bool homogeneous = false;     ///< a fourth coordinate w
  bool any_dimensions = false;  ///< nOFF: the number of coordinates follows
  std::string_view rest;        ///< of the header's line
};

struct Counts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The header that `line` begins with, if it does. Counts may be glued to it: "OFF490 518 0".
std::optional<Header> parse_header(std::string_view line) {
  Header header;
  header.rest = line;
  const auto take = [&](std::string_view part) {
    const bool there = header.rest.starts_with(part);
    if (there) header.rest.remove_prefix(part.size());
    return there;
  };
  header.texture = take("ST");
  header.colour = take("C");
  header.normal = take("N");
  header.texture = take("ST") || header.texture;  // where MeshLab puts it
  header.homogeneous = take("4");
  header.any_dimensions = take("n");
  if (!take("OFF")) return std::nullopt;
  const char next = header.rest.empty() ? ' ' : header.rest.front();
  if (next != ' ' && next != '\t' && !is_digit(next)) return std::nullopt;
  header.word = line.substr(0, line.size() - header.rest.size());
  return header;
}

Header read_header(const Source& source, TextLines& lines, Reading& reading) {
  std::string_view line;
  if (!lines.next_content(line, &reading.cloud.comments)) lines.refuse_end("an OFF header");
  const std::optional<Header> found = parse_header(line);
  if (found && found->any_dimensions) {
    throw InputError(source.name, Place::line(lines.number()), quoted(found->word),
                     "OFF with 3 coordinates per vertex");
  }
  if (found && starts_with_ignoring_case(trimmed(found->rest), "binary")) {
    throw InputError(source.name, Place::line(lines.number()), "binary OFF",
                     "ascii OFF, the only one that is read");
  }
  Header header = found.value_or(Header{});
  if (!found) {
    // The header word is optional; what stands in its place must then be the counts.
    if (!is_digit(line.front()))
      Words(source, line, lines.number()).refuse(line, "a header word such as OFF");
    header.rest = line;
    reading.notes.emplace_back("the header word OFF is missing");
  }
  reading.encoding = header.word.empty() ? "ascii" : fmt::format("ascii {}", header.word);
  if (trimmed(header.rest).empty() && !lines.next_content(header.rest, &reading.cloud.comments))
    lines.refuse_end("the numbers of vertices and faces");
  return header;
}

/// \param line the words that should be the counts, from the line that `lines` gave last
Counts read_counts(const Source& source, std::string_view line, const TextLines& lines) {
  Words words(source, line, lines.number());
  Counts counts;
  counts.vertices = words.number<std::uint64_t>("the number of vertices");
  counts.faces = words.number<std::uint64_t>("the number of faces");
  // The number of edges may be missing and need not be right.
  if (!trimmed(words.rest()).empty()) (void)words.number<std::int64_t>("the number of edges");
  words.expect_end();

  const Place here = Place::line(lines.number());
  if (counts.vertices > max_points) {
    throw InputError(source.name, here, fmt::format("{} vertices", counts.vertices),
                     fmt::format("at most {}", max_points));
  }
  // The shortest vertex is "0 0 0\n", the shortest face "0\n"; the last line may lack its end.
  const std::uint64_t room = lines.rest().size() + 1;
  if (counts.vertices > room / 6 || counts.faces > (room - counts.vertices * 6) / 2) {
    throw InputError(source.name, here,
                     fmt::format("{} vertices and {} faces", counts.vertices, counts.faces),
                     fmt::format("no more than fit into the {} bytes after this line", lines.rest().size()));
  }
  return counts;
}

/// What the columns of the vertices mean.
struct Layout {
  std::vector<std::string> names;
  std::size_t first_unnamed = 0;  ///< from here on, what no header word announces
  std::size_t first_colour = 0;
  std::size_t colours = 0;
};

/// \param lines at the first vertex; how many numbers it has tells what the header leaves open
Layout read_layout(const Source& source, const Header& header, TextLines lines) {
  std::string_view line;
  if (!lines.next_content(line)) lines.refuse_end("a vertex");
  std::size_t count = 0;
  for (Words words(source, line, lines.number()); count <= most_columns && !words.next().empty();) ++count;

  Layout layout;
  std::vector<std::string>& names = layout.names;
  const auto append = [&](std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  append({"x", "y", "z"});
  if (header.homogeneous) append({"w"});
  if (header.normal) append({"nx", "ny", "nz"});
  layout.first_colour = names.size();
  if (header.colour) append({"red", "green", "blue"});
  if (header.colour && count == names.size() + 1 + (header.texture ? 2 : 0)) append({"alpha"});
  layout.colours = names.size() - layout.first_colour;
  if (header.texture) append({"s", "t"});

  layout.first_unnamed = names.size();
  const bool plain = !header.normal && !header.colour && !header.texture;
  while (plain && count <= most_columns && names.size() < count)
    names.push_back(fmt::format("column_{}", names.size() + 1));
  if (count != names.size()) {
    throw InputError(source.name, Place::line(lines.number()), fmt::format("{} numbers", count),
                     fmt::format("{} ({})", names.size(), fmt::join(names, " ")));
  }
  return layout;
}

bool holds_bytes(const Column& column) {
  if (column.type() != ScalarType::Int32) return false;
  const std::span<const std::int32_t> values = column.values<std::int32_t>();
  return std::all_of(values.begin(), values.end(), [](std::int32_t v) { return v >= 0 && v <= 255; });
}

template <typename T>
Column converted(const Column& column) {
  Column result(column.name(), scalar_type_of<T>(), column.rows());
  const std::span<T> values = result.values<T>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(column.value(i));
  return result;
}

void keep_vertices(std::vector<Column> columns, const Layout& layout, PointCloud& cloud) {
  cloud.positions.resize(columns.front().rows());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::span<const double> values = columns[axis].values<double>();
    for (std::size_t i = 0; i < values.size(); ++i) cloud.positions[i][axis] = values[i];
  }
  const std::span<Column> colours = std::span(columns).subspan(layout.first_colour, layout.colours);
  // Integers up to 255 or fractions up to 1: one fraction anywhere makes all of them fractions.
  const bool bytes = std::all_of(colours.begin(), colours.end(), holds_bytes);
  for (Column& colour : colours) colour = bytes ? converted<std::uint8_t>(colour) : converted<double>(colour);
  cloud.attributes.assign(std::make_move_iterator(columns.begin() + 3),
                          std::make_move_iterator(columns.end()));
}

/// \return what follows the last vertex
TextLines read_vertices(const Source& source, const Header& header, const Counts& counts,
                        const TextLines& lines, Reading& reading, Progress& progress) {
  if (counts.vertices == 0) return lines;
  const Layout layout =
      read_layout(source, header, TextLines(source, lines.rest(), lines.number() + 1, no_progress()));
  RowFormat format;
  format.comments = true;
  format.names = layout.names;
  format.types.assign(layout.names.size(), ScalarType::Float64);
  for (std::size_t i = 0; i < layout.colours; ++i) format.inferred.push_back(layout.first_colour + i);
  for (std::size_t i = layout.first_unnamed; i < layout.names.size(); ++i) format.inferred.push_back(i);
  Rows rows = read_rows(source, lines.rest(), lines.number() + 1, format, counts.vertices, progress);
  keep_vertices(std::move(rows.columns), layout, reading.cloud);
  std::move(rows.notes.begin(), rows.notes.end(), std::back_inserter(reading.notes));
  if (header.homogeneous)
    reading.notes.emplace_back("w is kept as an attribute; positions are not divided by it");
  return {source, lines.rest().substr(rows.consumed), rows.next_line, progress};
}

/// One face: "n i1 … in [colour]", into `corners`. \return whether a colour of up to 4 numbers follows.
bool read_face(Words words, std::uint64_t vertices, std::vector<std::uint32_t>& corners,
               const Progress& progress) {
  const auto length = words.number<std::uint64_t>("the number of a face's vertices");
  corners.clear();  // and not reserved: `length` is only a claim
  for (std::uint64_t i = 0; i < length; ++i) {
    const std::string_view word = words.next();
    std::uint32_t vertex = 0;
    if (parse_number(word, vertex) != Parsed::Ok || vertex >= vertices)
      words.refuse(word, expected_vertex_number(0, vertices));
    corners.push_back(vertex);
    if (i % 4096 == 4095) progress.check();
  }
  if (words.rest().empty()) return false;
  for (int i = 0; i < 4 && !words.rest().empty(); ++i)
    (void)words.number<double>("a number of the face's colour");
  words.expect_end();
  return true;
}

void read_faces(const Source& source, const Counts& counts, TextLines lines, Reading& reading,
                const Progress& progress) {
  FaceBuilder faces;
  std::vector<std::uint32_t> corners;
  std::uint64_t coloured = 0;
  std::string_view line;
  while (faces.rows() < counts.faces) {
    if (!lines.next_content(line))
      lines.refuse_end(fmt::format("face {} of {}", faces.rows() + 1, counts.faces));
    if (read_face(Words(source, line, lines.number()), counts.vertices, corners, progress)) ++coloured;
    faces.add(corners);
  }
  if (lines.next_content(line)) {
    Words(source, line, lines.number())
        .refuse(line, fmt::format("the end of the file after {} vertices and {} faces", counts.vertices,
                                  counts.faces));
  }
  if (counts.faces > 0) reading.cloud.tables.push_back(faces.finish());
  if (coloured > 0) reading.notes.push_back(fmt::format("the colours of {} faces are not kept", coloured));
}

}  // namespace

Reading read_off(const Source& source, Progress& progress) {
  Reading reading;
  reading.format = "off";
  TextLines lines(source, progress);
  const Header header = read_header(source, lines, reading);
  const Counts counts = read_counts(source, header.rest, lines);
  lines.report();
  lines = read_vertices(source, header, counts, lines, reading, progress);
  read_faces(source, counts, lines, reading, progress);
  return reading;
}

Format::Match match_off(const Source& source) {
  constexpr std::size_t longest_preface = 65536;
  LineReader lines(without_bom(source.bytes).substr(0, longest_preface));
  std::string_view line;
  while (lines.next(line)) {
    if (line = trimmed(line.substr(0, line.find('#'))); !line.empty())
      return parse_header(line) ? Format::Match::Strong : Format::Match::No;
  }
  return Format::Match::No;
}

}  // namespace keenline
