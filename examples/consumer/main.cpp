// Finds the sharp points of a cube that is sampled at random.
#include <cstdio>

#include <keenline/detect/gauss.h>
#include <keenline/neighborhood/neighborhoods.h>
#include <keenline/synth/synth.h>

int main() {
  keenline::SynthOptions shape;
  shape.shape = "cube";
  shape.points = 5000;
  const keenline::PointCloud cloud = keenline::synthesize(shape).cloud;

  const keenline::Neighborhoods neighborhoods = keenline::find_neighborhoods(cloud, 16);
  const keenline::FeatureLabels labels = keenline::detect_gauss(cloud, neighborhoods);

  std::size_t sharp = 0;
  for (const keenline::Kind kind : labels.kind) sharp += keenline::is_feature(kind) ? 1 : 0;
  std::printf("%zu of %zu points are sharp\n", sharp, cloud.size());
  return sharp > 0 ? 0 : 1;
}
