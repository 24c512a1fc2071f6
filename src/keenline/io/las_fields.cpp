#include "keenline/io/las_fields.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/las_header.h"
#include "keenline/io/records.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/unique_names.h"

namespace keenline {
namespace {

constexpr std::size_t coordinate_bytes = 12;

bool has_time(unsigned format) { return format == 1 || format >= 3; }
bool has_color(unsigned format) {
  return format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
}
bool has_infrared(unsigned format) { return format == 8 || format == 10; }
bool has_waveform(unsigned format) { return format == 4 || format == 5 || format == 9 || format == 10; }

/// Lays fields one behind the other.
class Layout {
 public:
  explicit Layout(std::size_t start) : end_(start) {}

  void add(std::string name, ScalarType type) {
    fields_.push_back({std::move(name), end_, type, 1, false, 0, 0, {}});
    end_ += size_of(type);
  }

  struct Bits {
    std::string_view name;
    std::uint8_t count;
  };
  /// A byte that several fields share, from the lowest bit up.
  void add_bits(std::initializer_list<Bits> parts) {
    unsigned shift = 0;
    for (const Bits& part : parts) {
      fields_.push_back({std::string(part.name),
                         end_,
                         ScalarType::UInt8,
                         1,
                         false,
                         static_cast<std::uint8_t>(shift),
                         part.count,
                         {}});
      shift += part.count;
    }
    end_ += 1;
  }

  [[nodiscard]] std::size_t end() const { return end_; }
  [[nodiscard]] std::vector<LasField> fields() && { return std::move(fields_); }

 private:
  std::size_t end_;
  std::vector<LasField> fields_;
};

void add_oldest_part(Layout& layout) {
  layout.add("intensity", ScalarType::UInt16);
  layout.add_bits({{"return_number", 3},
                   {"number_of_returns", 3},
                   {"scan_direction_flag", 1},
                   {"edge_of_flight_line", 1}});
  layout.add_bits({{"classification", 5}, {"synthetic", 1}, {"key_point", 1}, {"withheld", 1}});
  layout.add("scan_angle_rank", ScalarType::Int8);
  layout.add("user_data", ScalarType::UInt8);
  layout.add("point_source_id", ScalarType::UInt16);
}

void add_newer_part(Layout& layout) {
  layout.add("intensity", ScalarType::UInt16);
  layout.add_bits({{"return_number", 4}, {"number_of_returns", 4}});
  layout.add_bits({{"synthetic", 1},
                   {"key_point", 1},
                   {"withheld", 1},
                   {"overlap", 1},
                   {"scanner_channel", 2},
                   {"scan_direction_flag", 1},
                   {"edge_of_flight_line", 1}});
  layout.add("classification", ScalarType::UInt8);
  layout.add("user_data", ScalarType::UInt8);
  layout.add("scan_angle", ScalarType::Int16);
  layout.add("point_source_id", ScalarType::UInt16);
}

/// LAS 1.4 specification R15, tables 7 to 18.
Layout standard_layout(unsigned format) {
  Layout layout(coordinate_bytes);
  format <= 5 ? add_oldest_part(layout) : add_newer_part(layout);
  if (has_time(format)) layout.add("gps_time", ScalarType::Float64);
  if (has_color(format))
    for (const char* name : {"red", "green", "blue"}) layout.add(name, ScalarType::UInt16);
  if (has_infrared(format)) layout.add("nir", ScalarType::UInt16);
  if (has_waveform(format)) {
    layout.add("wave_packet_index", ScalarType::UInt8);
    layout.add("wave_packet_offset", ScalarType::UInt64);
    layout.add("wave_packet_size", ScalarType::UInt32);
    layout.add("wave_return_location", ScalarType::Float32);
    for (const char* name : {"wave_dx", "wave_dy", "wave_dz"}) layout.add(name, ScalarType::Float32);
  }
  return layout;
}

constexpr std::size_t descriptor_size = 192;

/// One description of the Extra Bytes record; LAS 1.4 specification R15, table 24.
LasField described_field(const Source& source, std::string_view descriptor, std::size_t place,
                         std::size_t position) {
  constexpr std::size_t type_at = 2;
  constexpr std::size_t options_at = 3;
  constexpr std::size_t name_at = 4;
  constexpr std::size_t name_size = 32;
  constexpr std::size_t scale_at = 112;
  constexpr std::size_t offset_at = 136;
  constexpr unsigned has_scale = 8;
  constexpr unsigned has_offset = 16;
  constexpr std::array types{ScalarType::UInt8,   ScalarType::Int8,   ScalarType::UInt16, ScalarType::Int16,
                             ScalarType::UInt32,  ScalarType::Int32,  ScalarType::UInt64, ScalarType::Int64,
                             ScalarType::Float32, ScalarType::Float64};

  const unsigned type = load<std::uint8_t>(descriptor.data() + type_at);
  const unsigned options = load<std::uint8_t>(descriptor.data() + options_at);
  const std::string_view name = descriptor.substr(name_at, name_size);
  LasField field;
  field.name = trimmed(name.substr(0, name.find('\0')));
  field.position = position;
  if (type == 0) {
    // Of unknown meaning: the options are the number of bytes.
    if (options == 0) {
      throw InputError(source.name, Place::byte(place + options_at),
                       fmt::format("extra dimension {} of 0 bytes", quoted(field.name)), "at least 1");
    }
    field.is_list = true;
    field.values = options;
    return field;
  }
  if (type > 3 * types.size()) {
    throw InputError(source.name, Place::byte(place + type_at),
                     fmt::format("data type {} of extra dimension {}", type, quoted(field.name)), "0 to 30");
  }
  field.type = types[(type - 1) % types.size()];
  field.values = (type - 1) / types.size() + 1;
  field.is_list = field.values > 1;
  if ((options & (has_scale | has_offset)) == 0) return field;
  field.transform.emplace();
  for (std::size_t k = 0; k < field.values; ++k) {
    if ((options & has_scale) != 0)
      field.transform->scale[k] = load<double>(descriptor.data() + scale_at + 8 * k);
    if ((options & has_offset) != 0)
      field.transform->offset[k] = load<double>(descriptor.data() + offset_at + 8 * k);
    if (!std::isfinite(field.transform->scale[k]) || !std::isfinite(field.transform->offset[k])) {
      throw InputError(source.name, Place::byte(place + scale_at),
                       fmt::format("scale {} and offset {} of extra dimension {}", field.transform->scale[k],
                                   field.transform->offset[k], quoted(field.name)),
                       "finite numbers");
    }
  }
  return field;
}

/// Appends the described fields; returns where they end in the record.
std::size_t add_described_fields(const Source& source, const LasRecord& record, std::size_t position,
                                 std::size_t record_length, std::vector<LasField>& fields) {
  if (record.data.size() % descriptor_size != 0) {
    throw InputError(source.name, Place::byte(record.data_start),
                     fmt::format("an Extra Bytes description of {} bytes", record.data.size()),
                     fmt::format("a multiple of {}", descriptor_size));
  }
  for (std::size_t at = 0; at < record.data.size(); at += descriptor_size) {
    const std::size_t place = record.data_start + at;
    LasField field = described_field(source, record.data.substr(at, descriptor_size), place, position);
    const std::size_t bytes = field.values * size_of(field.type);
    if (bytes > record_length - position) {
      throw InputError(source.name, Place::byte(place),
                       fmt::format("extra dimension {} of {} bytes", quoted(field.name), bytes),
                       fmt::format("at most {}, which are left in a point", record_length - position));
    }
    position += bytes;
    fields.push_back(std::move(field));
  }
  return position;
}

void make_names_unique(std::vector<LasField>& fields, std::vector<std::string>& notes) {
  UniqueNames names({"x", "y", "z"});
  for (LasField& field : fields) {
    std::string name = names.claim(field.name.empty() ? "extra" : field.name);
    if (name != field.name) {
      notes.push_back(
          fmt::format("the extra dimension {} is called {} here", quoted(field.name), quoted(name)));
    }
    field.name = std::move(name);
  }
}

}  // namespace

std::size_t las_point_size(unsigned format) { return standard_layout(format).end(); }

std::vector<LasField> las_fields(const Source& source, const LasHeader& header,
                                 std::vector<std::string>& notes) {
  Layout layout = standard_layout(header.point_format);
  std::size_t position = layout.end();
  std::vector<LasField> fields = std::move(layout).fields();
  bool described = false;
  for (const LasRecord& record : header.records) {
    if (record.user_id != "LASF_Spec" || record.id != 4) continue;
    if (std::exchange(described, true)) {
      throw InputError(source.name, Place::byte(record.data_start), "a second Extra Bytes description",
                       "one");
    }
    position = add_described_fields(source, record, position, header.record_length, fields);
  }
  if (position < header.record_length) {
    fields.push_back(
        {"extra_bytes", position, ScalarType::UInt8, header.record_length - position, true, 0, 0, {}});
  }
  make_names_unique(fields, notes);
  return fields;
}

}  // namespace keenline
