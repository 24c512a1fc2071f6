#include "keenline/detect/spectrum_attributes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/kernels/line_angles.h"

namespace keenline {
namespace {

constexpr std::string_view from_name = "spectrum_from";
constexpr std::string_view kind_name = "spectrum_kind";
constexpr std::string_view clusters_name = "spectrum_clusters";
constexpr std::array attribute_names{from_name, kind_name, clusters_name};

constexpr std::string_view sigma_comment = "keenline sigma ";

template <typename T>
Column list_column(std::string_view name, ScalarType type, ScalarType count_type,
                   const LabelSpectrum& spectrum, const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return {std::string(name), type, count_type, spectrum.offsets, std::move(bytes)};
}

/// Lists of one or two values are the rule, and all have the same type of length. Steps rise strictly within
/// 16 bits, so that no list is longer than that.
ScalarType count_type_for(const LabelSpectrum& spectrum) {
  std::uint64_t longest = 0;
  for (std::size_t i = 0; i < spectrum.size(); ++i)
    longest = std::max(longest, spectrum.offsets[i + 1] - spectrum.offsets[i]);
  return longest <= std::numeric_limits<std::uint8_t>::max() ? ScalarType::UInt8 : ScalarType::UInt16;
}

[[noreturn]] void refuse(const Column& column, std::size_t point, std::string_view found,
                         std::string_view expected) {
  throw InvalidArgument(fmt::format("attribute {}, point {}: found {}, expected {}", quoted(column.name()),
                                    point, found, expected));
}

/// The point whose list holds value number `value`.
std::size_t point_of(const Column& column, std::size_t value) {
  const auto offsets = column.offsets();
  return static_cast<std::size_t>(std::upper_bound(offsets.begin(), offsets.end(), value) - offsets.begin()) -
         1;
}

const Column& list_attribute(const PointCloud& cloud, std::string_view name) {
  constexpr std::string_view expected = "the lists that keenline detect --spectrum writes";
  const Column* const column = cloud.attribute(name);
  if (column == nullptr)
    throw InvalidArgument(fmt::format("no attribute {}, expected {}", quoted(name), expected));
  const bool is_integer =
      visit_type(column->type(), [](auto zero) { return std::is_integral_v<decltype(zero)>; });
  if (!column->is_list() || !is_integer)
    throw InvalidArgument(fmt::format("attribute {}: found {}{}, expected a list of integers", quoted(name),
                                      column->is_list() ? "a list of " : "", name_of(column->type())));
  if (column->rows() != cloud.size())
    throw InvalidArgument(fmt::format("attribute {}: found {} lists for {} points", quoted(name),
                                      column->rows(), cloud.size()));
  return *column;
}

void require_same_lengths(const Column& column, const Column& first) {
  const auto offsets = column.offsets();
  const auto expected = first.offsets();
  for (std::size_t i = 0; i < column.rows(); ++i) {
    const std::uint64_t length = offsets[i + 1] - offsets[i];
    const std::uint64_t wanted = expected[i + 1] - expected[i];
    if (length != wanted)
      refuse(column, i, fmt::format("{} values", length),
             fmt::format("{} as in {}", wanted, quoted(first.name())));
  }
}

/// \pre a list of integers
template <typename To>
std::vector<To> numbers_of(const Column& column, To largest) {
  return visit_type(column.type(), [&](auto zero) {
    using From = decltype(zero);
    std::vector<To> numbers(column.value_count());
    if constexpr (std::is_integral_v<From>) {
      const auto values = column.values<From>();
      const auto wrong = std::find_if(values.begin(), values.end(), [&](From value) {
        return std::cmp_less(value, 0) || std::cmp_greater(value, largest);
      });
      if (wrong != values.end()) {
        const auto place = static_cast<std::size_t>(wrong - values.begin());
        refuse(column, point_of(column, place), fmt::format("{}", *wrong), fmt::format("0 to {}", largest));
      }
      std::copy(values.begin(), values.end(), numbers.begin());
    }
    return numbers;
  });
}

void require_rising_steps(const Column& column, const LabelSpectrum& spectrum) {
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const std::uint64_t begin = spectrum.offsets[i];
    const std::uint64_t end = spectrum.offsets[i + 1];
    if (begin == end) refuse(column, i, "an empty list", "a value for each step of the point");
    if (spectrum.from[begin] != 0)
      refuse(column, i, fmt::format("{} as the first value", spectrum.from[begin]), "0");
    for (std::uint64_t s = begin + 1; s < end; ++s)
      if (spectrum.from[s] <= spectrum.from[s - 1])
        refuse(column, i, fmt::format("{} after {}", spectrum.from[s], spectrum.from[s - 1]),
               "rising values");
  }
}

std::vector<Kind> kinds_of(const Column& column) {
  const std::vector<std::uint8_t> numbers = numbers_of<std::uint8_t>(column, 255);
  std::array<bool, 256> is_known{};
  for (const Kind kind : all_kinds) is_known[static_cast<std::size_t>(kind)] = true;
  std::vector<Kind> kinds(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!is_known[numbers[i]])
      refuse(column, point_of(column, i), fmt::format("{}", numbers[i]), "the number of a kind");
    kinds[i] = static_cast<Kind>(numbers[i]);
  }
  return kinds;
}

bool is_sigma_comment(const std::string& comment) { return comment.starts_with(sigma_comment); }

}  // namespace

std::vector<Column> spectrum_columns(const LabelSpectrum& spectrum) {
  const ScalarType count_type = count_type_for(spectrum);
  std::vector<Column> columns;
  columns.push_back(list_column(from_name, ScalarType::UInt16, count_type, spectrum, spectrum.from));
  columns.push_back(list_column(kind_name, ScalarType::UInt8, count_type, spectrum, spectrum.kind));
  columns.push_back(list_column(clusters_name, ScalarType::UInt8, count_type, spectrum, spectrum.clusters));
  return columns;
}

LabelSpectrum spectrum_of(const PointCloud& cloud) {
  const Column& from = list_attribute(cloud, from_name);
  const Column& kind = list_attribute(cloud, kind_name);
  const Column& clusters = list_attribute(cloud, clusters_name);
  require_same_lengths(kind, from);
  require_same_lengths(clusters, from);
  LabelSpectrum spectrum;
  spectrum.offsets.assign(from.offsets().begin(), from.offsets().end());
  spectrum.from = numbers_of<std::uint16_t>(from, std::uint16_t{kernels::right_angle});
  require_rising_steps(from, spectrum);
  spectrum.kind = kinds_of(kind);
  spectrum.clusters = numbers_of<std::uint8_t>(clusters, 255);
  return spectrum;
}

std::vector<std::string> remove_spectrum(PointCloud& cloud) {
  std::vector<std::string> removed;
  std::erase_if(cloud.attributes, [&](const Column& column) {
    if (std::find(attribute_names.begin(), attribute_names.end(), column.name()) == attribute_names.end())
      return false;
    removed.push_back(column.name());
    return true;
  });
  std::erase_if(cloud.comments, is_sigma_comment);
  return removed;
}

void set_sigma_comment(PointCloud& cloud, double sigma_deg) {
  const std::string comment =
      sigma_deg > 0 ? fmt::format("{}{}", sigma_comment, sigma_deg) : fmt::format("{}local", sigma_comment);
  const auto found = std::find_if(cloud.comments.begin(), cloud.comments.end(), is_sigma_comment);
  if (found == cloud.comments.end()) {
    cloud.comments.push_back(comment);
    return;
  }
  *found = comment;
  cloud.comments.erase(std::remove_if(found + 1, cloud.comments.end(), is_sigma_comment),
                       cloud.comments.end());
}

}  // namespace keenline
