#include "keenline/pipeline.h"

#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::TemporaryFolder;

std::string cube_file(const TemporaryFolder& folder) {
  SynthOptions options;
  options.points = 2000;
  const std::string path = folder.file("cube.ply");
  (void)write_cloud(path, synthesize(options).cloud);
  return path;
}

TEST(Pipeline, FromAFileToALabelledFile) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.output = folder.file("out.ply");
  const DetectReport report = run_detect(job);
  EXPECT_EQ(report.points, 2000U);
  EXPECT_EQ(report.finite_points, 2000U);
  EXPECT_EQ(report.format, "ply");
  EXPECT_EQ(report.options.at("neighbors"), 16.0);
  EXPECT_GT(report.times.total_s, 0);

  const PointCloud in = read_cloud(job.input).cloud;
  const PointCloud out = read_cloud(job.output).cloud;
  EXPECT_EQ(out.positions, in.positions);
  EXPECT_EQ(out.position_types, in.position_types);
  for (const Column& column : in.attributes) {
    const Column* const kept = out.attribute(column.name());
    ASSERT_NE(kept, nullptr) << column.name();
    EXPECT_EQ(kept->type(), column.type());
    EXPECT_TRUE(
        std::equal(kept->bytes().begin(), kept->bytes().end(), column.bytes().begin(), column.bytes().end()));
  }
  std::size_t features = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto kind = static_cast<Kind>(out.attribute("kind")->values<std::uint8_t>()[i]);
    EXPECT_EQ(kind, report.labels.kind[i]);
    EXPECT_EQ(out.attribute("feature")->values<std::uint8_t>()[i], is_feature(kind) ? 1 : 0);
    EXPECT_EQ(out.attribute("score")->values<float>()[i], report.labels.score[i]);
    EXPECT_EQ(out.attribute("clusters")->values<std::uint8_t>()[i], report.labels.clusters[i]);
    features += is_feature(kind) ? 1U : 0U;
  }
  EXPECT_GT(features, 100U);
  EXPECT_LT(features, 1000U);
}

TEST(Pipeline, LabelsOfAnEarlierRunAreReplacedAndNoted) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.output = folder.file("once.ply");
  (void)run_detect(job);
  job.input = job.output;
  job.output = folder.file("twice.ply");
  const DetectReport report = run_detect(job);
  EXPECT_EQ(report.notes.size(), 4U);
  EXPECT_EQ(TemporaryFolder::read(folder.file("once.ply")), TemporaryFolder::read(folder.file("twice.ply")));
}

TEST(Pipeline, TheInputIsNeverTheOutput) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  const std::string before = TemporaryFolder::read(job.input);
  std::filesystem::create_symlink("cube.ply", folder.path() / "link.ply");
  std::filesystem::create_hard_link(job.input, folder.path() / "hard.ply");
  for (const char* const name : {"cube.ply", "./cube.ply", "link.ply", "hard.ply"}) {
    job.output = folder.file(name);
    test::expect_error<InvalidArgument>([&] { (void)run_detect(job); }, "is the input");
  }
  EXPECT_EQ(TemporaryFolder::read(job.input), before);
}

TEST(Pipeline, MistakesAreFoundBeforeTheWork) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = folder.file("does-not-exist");
  job.output = folder.file("out.txt");
  EXPECT_THROW((void)run_detect(job), InvalidArgument);
  job.output = folder.file("no-folder/out.ply");
  EXPECT_THROW((void)run_detect(job), OutputError);
  job.output = folder.file("out.ply");
  EXPECT_THROW((void)run_detect(job), InputError);
  job.method = "magic";
  EXPECT_THROW((void)run_detect(job), InvalidArgument);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Pipeline, AddLabelsChecksTheLength) {
  PointCloud cloud;
  cloud.positions.resize(3);
  FeatureLabels labels;
  labels.kind.resize(2);
  labels.score.resize(2);
  EXPECT_THROW(add_labels(cloud, labels), InvalidArgument);
}

}  // namespace
}  // namespace keenline
