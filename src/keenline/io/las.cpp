#include "keenline/io/las.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "keenline/io/crs.h"
#include "keenline/io/las_fields.h"
#include "keenline/io/las_header.h"
#include "keenline/io/records.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/memory.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

template <typename Function>
void for_all(std::size_t count, Progress& progress, const Function& function) {
  constexpr std::size_t block = 65536;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, block),
      [&](const tbb::blocked_range<std::size_t>& range) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
      },
      tbb::simple_partitioner());
}

/// Room for the values of a field as they are stored.
Column stored_column(const LasField& field, std::uint64_t count) {
  if (!field.is_list) return {field.name, field.type, count};
  std::vector<std::uint64_t> offsets(count + 1);
  for (std::uint64_t i = 0; i <= count; ++i) offsets[i] = i * field.values;
  return {field.name, field.type, ScalarType::UInt16, std::move(offsets),
          std::vector<std::byte>(count * field.values * size_of(field.type))};
}

/// Makes what the stored values mean out of them: some bits of a byte, or a number that was scaled to an
/// integer.
Column interpreted(const LasField& field, Column stored, Progress& progress) {
  if (field.bits > 0) {
    const auto values = stored.values<std::uint8_t>();
    const unsigned mask = (1U << field.bits) - 1;
    for_all(values.size(), progress, [&](std::size_t i) {
      values[i] = static_cast<std::uint8_t>((unsigned{values[i]} >> field.shift) & mask);
    });
  }
  if (!field.transform) return stored;
  Column result(field.name, ScalarType::Float64, stored.value_count());
  const auto values = result.values<double>();
  visit_type(field.type, [&](auto zero) {
    const auto from = stored.values<decltype(zero)>();
    for_all(values.size(), progress, [&](std::size_t i) {
      const std::size_t k = i % field.values;
      values[i] = static_cast<double>(from[i]) * field.transform->scale[k] + field.transform->offset[k];
    });
  });
  if (!field.is_list) return result;
  const auto bytes = result.bytes();
  return {field.name,
          ScalarType::Float64,
          stored.count_type(),
          {stored.offsets().begin(), stored.offsets().end()},
          {bytes.begin(), bytes.end()}};
}

void read_points(const Source& source, const LasHeader& header, const std::vector<LasField>& fields,
                 PointCloud& cloud, Progress& progress) {
  require_memory(header.point_count * (header.record_length + sizeof(Point)), "reading points");
  std::vector<Column> coordinates;
  std::vector<Column> columns;
  std::vector<RecordField> record;
  for (std::size_t d = 0; d < 3; ++d) {
    coordinates.emplace_back("coordinate", ScalarType::Int32, header.point_count);
    record.push_back({d * sizeof(std::int32_t), ScalarType::Int32, 1, coordinates.back().bytes().data()});
  }
  for (const LasField& field : fields) {
    columns.push_back(stored_column(field, header.point_count));
    record.push_back({field.position, field.type, field.values, columns.back().bytes().data()});
  }
  unpack_records({source.bytes.data() + header.points_start, header.point_count, header.record_length},
                 record, progress);

  cloud.positions.resize(header.point_count);
  for (std::size_t d = 0; d < 3; ++d) {
    const auto values = std::as_const(coordinates[d]).values<std::int32_t>();
    for_all(values.size(), progress,
            [&](std::size_t i) { cloud.positions[i][d] = values[i] * header.scale[d] + header.offset[d]; });
  }
  for (std::size_t i = 0; i < fields.size(); ++i)
    cloud.attributes.push_back(interpreted(fields[i], std::move(columns[i]), progress));
}

/// Text between zero bytes, on one line.
std::string one_line(std::string_view text) {
  std::string line(text.substr(0, text.find('\0')));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = ' ';
  return std::string(trimmed(line));
}

/// Keeps what the records say about the coordinate system, and tells what is left out.
void describe_records(const LasHeader& header, Reading& reading) {
  constexpr std::uint16_t wkt = 2112;
  constexpr std::uint16_t geotiff_keys = 34735;
  constexpr std::uint16_t last_geotiff = 34737;
  constexpr std::uint16_t extra_bytes = 4;
  bool is_lost = false;
  std::size_t others = 0;
  for (const LasRecord& record : header.records) {
    const bool projection = record.user_id == "LASF_Projection";
    if (projection && record.id == wkt) {
      reading.cloud.comments.push_back("crs_wkt " + one_line(record.data));
    } else if (projection && record.id == geotiff_keys) {
      const std::optional<int> epsg = epsg_of_geotiff_keys(record.data);
      if (epsg) reading.cloud.comments.push_back(fmt::format("crs_epsg {}", *epsg));
      else is_lost = true;
    } else if (projection && record.id > geotiff_keys && record.id <= last_geotiff) {
      continue;  // numbers and texts that the keys refer to
    } else if (record.user_id != "LASF_Spec" || record.id != extra_bytes) {
      ++others;
    }
  }
  if (is_lost)
    reading.notes.emplace_back(
        "the coordinate system, given as GeoTIFF keys without EPSG code, is not carried through");
  if (others > 0)
    reading.notes.push_back(fmt::format("{} variable length records are not carried through", others));
}

}  // namespace

Reading read_las(const Source& source, Progress& progress) {
  const LasHeader header = read_las_header(source);
  Reading reading;
  reading.encoding = fmt::format("1.{}, point format {}", header.minor_version, header.point_format);
  const std::vector<LasField> fields = las_fields(source, header, reading.notes);
  progress.advance(header.points_start);
  read_points(source, header, fields, reading.cloud, progress);
  describe_records(header, reading);
  if (std::any_of(fields.begin(), fields.end(),
                  [](const LasField& f) { return f.name == "wave_packet_index"; }))
    reading.notes.emplace_back("waveforms are not read; where they stand is kept as attributes");
  return reading;
}

Format::Match match_las(const Source& source) {
  return source.bytes.starts_with("LASF") ? Format::Match::Strong : Format::Match::No;
}

}  // namespace keenline
