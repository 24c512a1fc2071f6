#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "keenline/cloud.h"
#include "keenline/labels.h"

namespace keenline {

/// How often a prediction was right and wrong, in points.
struct Confusion {
  std::uint64_t true_positive = 0;
  std::uint64_t false_positive = 0;
  std::uint64_t false_negative = 0;
  std::uint64_t true_negative = 0;
};

/// Compares point by point: attribute `feature` of `prediction` with attribute `truth`, or without one
/// `truth_feature`, of `truth`; what is not 0 is positive. Both may be the same cloud.
/// \throw InvalidArgument when an attribute is missing, holds lists or NaN, or the clouds differ in size.
[[nodiscard]] Confusion compare(const PointCloud& prediction, const PointCloud& truth);

// Precision, recall, F1 and IoU lie in [0, 1]. One whose denominator is 0 is 0, unless there are neither
// predicted nor true positives: then nothing was missed and nothing invented, and all four are 1.

/// Share of the predicted positives that are true: TP / (TP + FP).
[[nodiscard]] double precision(const Confusion& c);
/// Share of the true positives that are predicted: TP / (TP + FN).
[[nodiscard]] double recall(const Confusion& c);
/// Harmonic mean of precision and recall: 2 TP / (2 TP + FP + FN).
[[nodiscard]] double f1(const Confusion& c);
/// Intersection over union of predicted and true positives: TP / (TP + FP + FN).
[[nodiscard]] double iou(const Confusion& c);
/// Matthews correlation coefficient, in [-1, 1]; 0 where it is undefined, because prediction or truth are all
/// alike.
[[nodiscard]] double mcc(const Confusion& c);

struct Scores {
  double precision = 0;
  double recall = 0;
  double f1 = 0;
  double mcc = 0;
  double iou = 0;
};

[[nodiscard]] Scores scores(const Confusion& c);

/// How often a point of one kind was taken for another: counts[truth][found], places as in all_kinds.
struct KindConfusion {
  std::array<std::array<std::uint64_t, all_kinds.size()>, all_kinds.size()> counts{};

  KindConfusion& operator+=(const KindConfusion& other);
};

/// Compares point by point attribute `kind` of `prediction` with attribute `truth_kind` of `truth`. Both may
/// be the same cloud. \throw InvalidArgument when an attribute is missing, holds something else than numbers
/// of kinds, or the clouds differ in size.
[[nodiscard]] KindConfusion compare_kinds(const PointCloud& prediction, const PointCloud& truth);

/// The scores of several clouds in one.
struct Summary {
  Scores macro_mean;  ///< of each score over the clouds
  Scores median;  ///< of each score over the clouds; of an even number of clouds, the mean of the middle two
  Scores micro;   ///< of all points of all clouds taken together
};

/// \throw InvalidArgument when there are no clouds.
[[nodiscard]] Summary summarize(std::span<const Confusion> clouds);

}  // namespace keenline
