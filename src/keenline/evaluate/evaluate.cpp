#include "keenline/evaluate/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr std::array all_scores{&Scores::precision, &Scores::recall, &Scores::f1, &Scores::mcc, &Scores::iou};

double as_double(std::uint64_t count) { return static_cast<double>(count); }

double ratio(const Confusion& c, double numerator, double denominator) {
  if (denominator > 0) return numerator / denominator;
  const bool nothing_to_find = c.true_positive == 0 && c.false_positive == 0 && c.false_negative == 0;
  return nothing_to_find ? 1 : 0;
}

/// Which points `column` calls positive.
std::vector<bool> positives(const Column& column) {
  if (column.is_list()) throw InvalidArgument(fmt::format("attribute {} holds lists", quoted(column.name())));
  std::vector<bool> result(column.rows());
  visit_type(column.type(), [&](auto zero) {
    const auto values = column.values<decltype(zero)>();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_floating_point_v<decltype(zero)>) {
        if (std::isnan(values[i])) {
          throw InvalidArgument(
              fmt::format("attribute {} of point {} is not a number", quoted(column.name()), i));
        }
      }
      result[i] = values[i] != zero;
    }
  });
  return result;
}

void require_same_size(const PointCloud& prediction, const PointCloud& truth) {
  if (prediction.size() == truth.size()) return;
  throw InvalidArgument(
      fmt::format("the prediction has {} points, the truth {}", prediction.size(), truth.size()));
}

/// For every point the place of its kind in all_kinds.
std::vector<std::size_t> kinds_in(const PointCloud& cloud, std::string_view attribute) {
  const Column* const column = cloud.attribute(attribute);
  if (column == nullptr || column->is_list())
    throw InvalidArgument(
        fmt::format("there is no attribute {} with one number per point", quoted(attribute)));
  std::vector<std::size_t> kinds;
  kinds.reserve(column->rows());
  for (std::size_t i = 0; i < column->rows(); ++i) {
    const double number = column->value(i);
    const auto kind = std::find_if(all_kinds.begin(), all_kinds.end(),
                                   [&](Kind k) { return static_cast<double>(k) == number; });
    if (kind == all_kinds.end())
      throw InvalidArgument(
          fmt::format("attribute {} of point {} is {}, which is no kind", quoted(attribute), i, number));
    kinds.push_back(static_cast<std::size_t>(kind - all_kinds.begin()));
  }
  return kinds;
}

}  // namespace

Confusion compare(const PointCloud& prediction, const PointCloud& truth) {
  const Column* const predicted = prediction.attribute("feature");
  if (predicted == nullptr) throw InvalidArgument("the prediction has no attribute 'feature'");
  const Column* expected = truth.attribute("truth");
  if (expected == nullptr) expected = truth.attribute("truth_feature");
  if (expected == nullptr)
    throw InvalidArgument("the truth has neither attribute 'truth' nor 'truth_feature'");
  require_same_size(prediction, truth);
  const std::vector<bool> found = positives(*predicted);
  const std::vector<bool> real = positives(*expected);
  Confusion c;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) ++(real[i] ? c.true_positive : c.false_positive);
    else ++(real[i] ? c.false_negative : c.true_negative);
  }
  return c;
}

KindConfusion& KindConfusion::operator+=(const KindConfusion& other) {
  for (std::size_t t = 0; t < counts.size(); ++t)
    for (std::size_t f = 0; f < counts.size(); ++f) counts[t][f] += other.counts[t][f];
  return *this;
}

KindConfusion compare_kinds(const PointCloud& prediction, const PointCloud& truth) {
  const std::vector<std::size_t> found = kinds_in(prediction, "kind");
  const std::vector<std::size_t> real = kinds_in(truth, "truth_kind");
  require_same_size(prediction, truth);
  KindConfusion confusion;
  for (std::size_t i = 0; i < found.size(); ++i) ++confusion.counts[real[i]][found[i]];
  return confusion;
}

double precision(const Confusion& c) {
  return ratio(c, as_double(c.true_positive), as_double(c.true_positive + c.false_positive));
}

double recall(const Confusion& c) {
  return ratio(c, as_double(c.true_positive), as_double(c.true_positive + c.false_negative));
}

double f1(const Confusion& c) {
  const std::uint64_t twice = 2 * c.true_positive;
  return ratio(c, as_double(twice), as_double(twice + c.false_positive + c.false_negative));
}

double iou(const Confusion& c) {
  return ratio(c, as_double(c.true_positive),
               as_double(c.true_positive + c.false_positive + c.false_negative));
}

double mcc(const Confusion& c) {
  // In doubles: a product of two counts of 2^32 overflows 64 bits.
  const double tp = as_double(c.true_positive);
  const double fp = as_double(c.false_positive);
  const double fn = as_double(c.false_negative);
  const double tn = as_double(c.true_negative);
  // Two roots, so that a perfect prediction scores exactly 1: the root of a rounded square is exact.
  const double denominator = std::sqrt((tp + fp) * (tp + fn)) * std::sqrt((tn + fp) * (tn + fn));
  return denominator > 0 ? (tp * tn - fp * fn) / denominator : 0;
}

Scores scores(const Confusion& c) { return {precision(c), recall(c), f1(c), mcc(c), iou(c)}; }

Summary summarize(std::span<const Confusion> clouds) {
  if (clouds.empty()) throw InvalidArgument("a summary needs at least one cloud");
  Summary summary;
  Confusion all;
  for (const Confusion& c : clouds) {
    all.true_positive += c.true_positive;
    all.false_positive += c.false_positive;
    all.false_negative += c.false_negative;
    all.true_negative += c.true_negative;
  }
  summary.micro = scores(all);

  for (const auto score : all_scores) {
    std::vector<double> values;
    for (const Confusion& c : clouds) values.push_back(scores(c).*score);
    std::sort(values.begin(), values.end());
    summary.macro_mean.*score = std::accumulate(values.begin(), values.end(), 0.0) / as_double(values.size());
    summary.median.*score = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
  }
  return summary;
}

}  // namespace keenline
