#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "keenline/cloud.h"

namespace keenline::test {

/// Uniform in the unit cube, the same on every platform.
inline std::vector<Point> random_points(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  const auto coordinate = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    points.push_back({x, y, coordinate()});
  }
  return points;
}

/// Clouds of about a thousand points that a search tree may stumble over, each with its name.
inline std::vector<std::pair<std::string, std::vector<Point>>> uneven_clouds() {
  const std::vector<Point> random = random_points(1000, 1);
  const auto made = [&](const auto& place) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < random.size(); ++i) points.push_back(place(random[i], i));
    return points;
  };
  std::vector<std::pair<std::string, std::vector<Point>>> clouds;
  clouds.emplace_back("volume", random);
  clouds.emplace_back("plane", made([](const Point& p, std::size_t) { return Point{p[0], p[1], 0}; }));
  clouds.emplace_back("line", made([](const Point& p, std::size_t) {
                        return Point{p[0], 2 * p[0], 3 * p[0]};
                      }));
  clouds.emplace_back("dense spot in a sparse plane", made([](const Point& p, std::size_t i) {
                        const double size = i % 3 == 0 ? 1 : 0.01;
                        return Point{p[0] * size, p[1] * size, 0};
                      }));
  clouds.emplace_back("spots within spots", made([](const Point& p, std::size_t i) {
                        const double size = std::ldexp(1.0, -6 * static_cast<int>(i % 40));
                        return Point{0.25 + p[0] * size, p[1] * size, p[2] * size};
                      }));
  clouds.emplace_back("outlier", made([](const Point& p, std::size_t i) {
                        return i == 500 ? Point{1e12, 0, 0} : p;
                      }));
  clouds.emplace_back("lattice", made([](const Point&, std::size_t i) {
                        const std::size_t j = i * 387 % 1000;  // shuffled
                        return Point{double(j % 10), double(j / 10 % 10), double(j / 100)};
                      }));
  clouds.emplace_back("lattice with copies", made([](const Point&, std::size_t i) {
                        const std::size_t j = i * 387 % 1000 / 3;
                        return Point{double(j % 19), double(j / 19), 0};
                      }));
  clouds.emplace_back("hundredths at large coordinates", made([](const Point& p, std::size_t) {
                        return Point{std::round(p[0] * 500) * 0.01 + 5e5, std::round(p[1] * 500) * 0.01 + 5e6,
                                     std::round(p[2] * 10) * 0.01};
                      }));
  return clouds;
}

}  // namespace keenline::test
