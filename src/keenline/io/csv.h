#pragma once

#include <string>
#include <vector>

namespace keenline {

class Progress;
class Sink;
struct PointCloud;

/// Comma-separated text with a header line: x, y, z, then the attributes, lists of constant length as name_0,
/// name_1, … Numbers have the shortest form that reads back to the same bits of their type. Returns notes:
/// what CSV could not hold (tables, comments, lists of varying length) or not under its name. \throw
/// OutputError from the sink; Cancelled.
std::vector<std::string> write_csv(const PointCloud& cloud, Sink& sink, Progress& progress);

}  // namespace keenline
