#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct DemarsinOptions;
struct GaussOptions;
class NeighborSearch;
struct PointCloud;
struct TensorVotingOptions;

/// One option of a method, stated once: the command line, bindings and docs take it from here.
struct OptionInfo {
  enum class Type { Integer, Real, Flag };  // a flag is 0 or 1
  std::string_view name;                    ///< as a flag without the dashes: "min-cluster"
  std::string_view summary;                 ///< one line
  Type type;
  double minimum;
  double maximum;
  bool minimum_excluded;  ///< the value must be larger than minimum
  std::string_view unit;  ///< "degrees", "points", … or empty
  /// Empty when the default is `automatic` (chosen from the data).
  std::optional<double> default_value;
  /// The word for "chosen from the data" (usually "auto"); empty when a number is needed.
  std::string_view automatic;
  /// A word that stands for the minimum where that is excluded, as "local" for a sigma of 0; or empty.
  std::string_view word_for_minimum = {};
};

/// Values given by a user, by option name; an empty value stands for the option's `automatic`.
using OptionValues = std::map<std::string, std::optional<double>, std::less<>>;

enum class MethodInput { Points, Mesh };

/// One published method: one row of the registry.
struct Method {
  std::string_view name;     ///< file, flag, docs page and test: "gauss"
  std::string_view summary;  ///< one line
  std::string_view paper;    ///< authors, year, title
  MethodInput input;
  std::span<const OptionInfo> options;
  /// How far a point's label depends on its surroundings, in nearest neighbours.
  int (*reach)(const OptionValues& values);
  /// Fills in the values that follow the cloud: the noise in spacings (see estimate_noise()), the finite
  /// points.
  void (*adapt)(OptionValues& values, double noise, std::size_t points);
  /// Do the values ask for the published method and nothing else? Then its points are not smoothed either.
  bool (*is_plain)(const OptionValues& values);
  /// The search is that of cloud.positions. `values` holds every option of the method (see resolve_options);
  /// it comes back with what was chosen from
  /// the data.
  FeatureLabels (*detect)(const PointCloud& cloud, const NeighborSearch& search, OptionValues& values,
                          Progress& progress);
};

/// All methods. The first one is the default.
[[nodiscard]] std::span<const Method> methods();

/// \throw InvalidArgument naming the known methods.
[[nodiscard]] const Method& find_method(std::string_view name);

/// "more than 0, up to 90 degrees, or auto": what a message or a help text says of an option's range.
[[nodiscard]] std::string range_of(const OptionInfo& option);

/// A value as a user would write it: "20", "auto", "local".
[[nodiscard]] std::string text_of(const OptionInfo& option, const std::optional<double>& value);

/// A value as reports and bindings hold it: the word of text_of() where it is one, else by the option's type.
[[nodiscard]] std::variant<bool, std::int64_t, double, std::string> told_value(
    const OptionInfo& option, const std::optional<double>& value);

/// Text from a user as a value of the option. \throw InvalidArgument with name, text and allowed range.
[[nodiscard]] std::optional<double> parse_option(const OptionInfo& option, std::string_view text);

/// All options of the method: given values where there are some, defaults elsewhere.
/// \throw InvalidArgument for a name that the method does not have or a value out of range.
[[nodiscard]] OptionValues resolve_options(const Method& method, const OptionValues& given);

/// \pre values hold every option of the method gauss (see resolve_options)
[[nodiscard]] GaussOptions gauss_options_from(const OptionValues& values);

/// \pre values hold every option of the method demarsin
[[nodiscard]] DemarsinOptions demarsin_options_from(const OptionValues& values);

/// \pre values hold every option of the method tensor_voting
[[nodiscard]] TensorVotingOptions tensor_voting_options_from(const OptionValues& values);

}  // namespace keenline
