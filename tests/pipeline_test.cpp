#include "keenline/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"
#include "keenline/report/report_page.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"
#include "support/report_file.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::expect_error;
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

TEST(Pipeline, LinesOfACubeByItsOwnLabelsOrNewOnes) {
  const TemporaryFolder folder;
  LinesJob job;
  job.input = cube_file(folder);
  job.outputs = {folder.file("cube.json"), folder.file("cube.dxf")};
  std::size_t told = 0;
  const LinesReport report = run_lines(job, no_progress(), [&](const LinesReport& r) {
    told = r.graph.polylines.size();
    EXPECT_FALSE(std::filesystem::exists(job.outputs[0]));
  });
  EXPECT_EQ(told, 12U);
  EXPECT_EQ(report.graph.corners.size(), 8U);
  EXPECT_EQ(report.method, "gauss");
  EXPECT_GT(report.detection.spacing, 0);
  EXPECT_EQ(report.detection.options.at("neighbors"), 16);
  EXPECT_GT(report.detection.times.lines_s, 0);
  EXPECT_EQ(read_graph(job.outputs[0]).polylines.size(), 12U);
  EXPECT_TRUE(std::filesystem::exists(job.outputs[1]));

  DetectJob detect;
  detect.input = job.input;
  detect.output = folder.file("labelled.ply");
  (void)run_detect(detect);
  job.input = detect.output;
  job.outputs = {folder.file("again.json")};
  const LinesReport again = run_lines(job);
  EXPECT_EQ(again.method, "");
  EXPECT_EQ(again.detection.notes.size(), 1U);
  EXPECT_EQ(TemporaryFolder::read(folder.file("again.json")),
            TemporaryFolder::read(folder.file("cube.json")));
  job.method = "gauss";
  EXPECT_EQ(run_lines(job).method, "gauss");
}

TEST(Pipeline, LinesRefuseMistakesBeforeTheWork) {
  const TemporaryFolder folder;
  LinesJob job;
  job.input = folder.file("does-not-exist");
  test::expect_error<InvalidArgument>([&] { (void)run_lines(job); }, "output", ".dxf");
  job.outputs = {folder.file("out.stl")};
  EXPECT_THROW((void)run_lines(job), InvalidArgument);
  job.outputs = {folder.file("no-folder/out.dxf")};
  EXPECT_THROW((void)run_lines(job), OutputError);
  job.outputs = {folder.file("out.dxf"), folder.file("./out.dxf")};
  EXPECT_THROW((void)run_lines(job), InvalidArgument);
  job.outputs = {folder.file("out.dxf")};
  EXPECT_THROW((void)run_lines(job), InputError);
  job.fit_spacings = -1;
  test::expect_error<InvalidArgument>([&] { (void)run_lines(job); }, "--fit");
  job.fit_spacings = 0;
  job.resample_spacings = std::numeric_limits<double>::quiet_NaN();
  test::expect_error<InvalidArgument>([&] { (void)run_lines(job); }, "--resample");
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Pipeline, LabelsOfACloudAreItsKindsOrItsFeatures) {
  PointCloud cloud;
  cloud.positions.resize(3);
  EXPECT_FALSE(labels_of(cloud));
  cloud.set_attribute(Column("feature", std::vector<double>{0, 1, -2.5}));
  EXPECT_EQ(labels_of(cloud)->kind, (std::vector<Kind>{Kind::Flat, Kind::Edge, Kind::Edge}));
  EXPECT_EQ(labels_of(cloud)->score, (std::vector<float>{1, 1, 1}));
  cloud.set_attribute(Column("score", std::vector<double>{0.5, 2, 3}));
  cloud.set_attribute(Column("kind", std::vector<std::int32_t>{255, 5, 3}));
  EXPECT_EQ(labels_of(cloud)->kind, (std::vector<Kind>{Kind::Undecided, Kind::Border, Kind::Corner}));
  EXPECT_EQ(labels_of(cloud)->score, (std::vector<float>{0.5F, 2, 3}));
  cloud.set_attribute(Column("kind", std::vector<double>{1, 2.5, 3}));
  EXPECT_FALSE(labels_of(cloud));
}

TEST(Pipeline, RelabellingGivesTheFileOfAFreshRun) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.options["spectrum"] = 1;
  job.output = folder.file("spectrum.ply");
  const DetectReport kept = run_detect(job);
  ASSERT_TRUE(kept.labels.spectrum);

  RelabelJob again;
  again.input = job.output;
  again.output = folder.file("relabelled.ply");
  again.sigma_rule = SigmaRule::Given;
  again.sigma_deg = 60;
  const RelabelReport report = run_relabel(again);
  EXPECT_EQ(report.points, 2000U);
  EXPECT_EQ(report.finite_points, 2000U);
  EXPECT_EQ(report.format, "ply");
  EXPECT_EQ(report.labels.sigma_deg, 60);
  EXPECT_TRUE(report.notes.empty());
  EXPECT_GT(report.times.total_s, 0);

  job.options["sigma"] = 60;
  job.output = folder.file("fresh.ply");
  const DetectReport fresh = run_detect(job);
  EXPECT_EQ(report.labels.kind, fresh.labels.kind);
  EXPECT_NE(report.labels.kind, kept.labels.kind);
  EXPECT_EQ(TemporaryFolder::read(again.output), TemporaryFolder::read(job.output));

  again.sigma_rule = SigmaRule::Auto;
  EXPECT_EQ(run_relabel(again).labels.sigma_deg, kept.labels.sigma_deg);
  EXPECT_EQ(TemporaryFolder::read(again.output), TemporaryFolder::read(again.input));
}

TEST(Pipeline, RelabellingRefusesWhatHasNoSpectrum) {
  const TemporaryFolder folder;
  RelabelJob job;
  job.sigma_rule = SigmaRule::Given;
  job.input = cube_file(folder);
  job.output = folder.file("out.ply");
  job.sigma_deg = 12;
  test::expect_error<InputError>([&] { (void)run_relabel(job); }, "cube.ply", "spectrum_from");
  job.sigma_deg = 91;
  test::expect_error<InvalidArgument>([&] { (void)run_relabel(job); }, "--sigma", "91");
  job.sigma_deg = 12;
  job.output = job.input;
  test::expect_error<InvalidArgument>([&] { (void)run_relabel(job); }, "is the input");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(Pipeline, ASpectrumNeedsAnOutputThatHoldsLists) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = folder.file("does-not-exist");
  job.output = folder.file("out.csv");
  job.options["spectrum"] = 1;
  test::expect_error<InvalidArgument>([&] { (void)run_detect(job); }, "--spectrum", "out.csv", ".ply");
  job.options["spectrum"] = 0;
  EXPECT_THROW((void)run_detect(job), InputError);
}

TEST(Pipeline, ASpectrumDoesNotOutliveItsLabels) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.output = folder.file("plain.ply");
  job.options["sigma"] = 25;
  (void)run_detect(job);
  job.options["spectrum"] = 1;
  job.output = folder.file("spectrum.ply");
  (void)run_detect(job);
  EXPECT_EQ(read_cloud(job.output).cloud.comments, std::vector<std::string>{"keenline sigma 25"});

  job.input = folder.file("spectrum.ply");
  job.output = folder.file("again.ply");
  DetectReport report = run_detect(job);
  EXPECT_EQ(report.notes.size(), 7U);
  EXPECT_EQ(TemporaryFolder::read(job.output), TemporaryFolder::read(job.input));

  job.options["spectrum"] = 0;
  report = run_detect(job);
  EXPECT_EQ(std::count_if(report.notes.begin(), report.notes.end(),
                          [](const std::string& note) { return note.find("left out") != std::string::npos; }),
            3);
  EXPECT_EQ(TemporaryFolder::read(job.output), TemporaryFolder::read(folder.file("plain.ply")));
}

/// With the page of this build; without one there is nothing to test.
class PipelineViews : public testing::Test {
 protected:
  void SetUp() override {
    if (report_page().empty()) GTEST_SKIP() << "built without the page";
  }
};

TEST_F(PipelineViews, AReportIsEnoughAndKnowsEverySensitivity) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.views.report = folder.file("cube.html");
  job.views.report_points = 1500;
  const DetectReport report = run_detect(job);
  EXPECT_FALSE(report.labels.spectrum);
  EXPECT_EQ(report.options.at("spectrum"), 0.0);
  EXPECT_EQ(folder.entries(), 2U);

  job.views = {};
  job.options = {{"spectrum", 1.0}};
  job.output = folder.file("out.ply");
  const FeatureLabels labels = run_detect(job).labels;
  const test::ReportFile file(TemporaryFolder::read(folder.file("cube.html")));
  EXPECT_EQ(file.facts.at("command"), "detect");
  EXPECT_EQ(file.facts.at("sigma_deg"), labels.sigma_deg);
  EXPECT_EQ(file.facts.at("sigma_rule"), "auto");
  EXPECT_EQ(file.facts.at("options").at("spectrum"), false);
  EXPECT_EQ(file.facts.at("cloud").at("kept"), 1500);
  EXPECT_EQ(file.facts.at("truth"), "truth_kind");
  const std::vector<std::uint32_t> index = file.numbers("index");
  const std::vector<std::uint32_t> steps = file.numbers("spectrum_count");
  ASSERT_EQ(index.size(), 1500U);
  for (std::size_t i = 0; i < index.size(); ++i) {
    const std::uint32_t point = index[i];
    EXPECT_EQ(steps[i], labels.spectrum->offsets[point + 1] - labels.spectrum->offsets[point]);
  }
}

TEST_F(PipelineViews, TheResultIsTheSameWithThem) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.output = folder.file("without.ply");
  (void)run_detect(job);
  job.output = folder.file("with.ply");
  job.views.report = folder.file("with.html");
  job.views.picture = folder.file("with.png");
  (void)run_detect(job);
  EXPECT_EQ(TemporaryFolder::read(folder.file("with.ply")),
            TemporaryFolder::read(folder.file("without.ply")));
  EXPECT_TRUE(TemporaryFolder::read(job.views.picture).starts_with("\x89PNG"));
}

TEST_F(PipelineViews, ASmoothedCloudComesWithWhatWasLookedAt) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.smoothing = Smoothing::Yes;
  job.method = "pauly";
  job.views.report = folder.file("cube.html");
  (void)run_detect(job);
  const test::ReportFile file(TemporaryFolder::read(job.views.report));
  EXPECT_EQ(file.facts.at("smoothed"), true);
  EXPECT_EQ(file.facts.at("sigma_rule"), nullptr);
  EXPECT_EQ(file.facts.at("sigma_deg"), nullptr);
  const std::vector<std::uint32_t> offsets = file.numbers("seen_offset");
  EXPECT_EQ(offsets.size(), 6000U);
  EXPECT_GT(std::count_if(offsets.begin(), offsets.end(), [](std::uint32_t o) { return o > 0; }), 1000);
}

TEST_F(PipelineViews, OfLinesHoldTheDrawing) {
  const TemporaryFolder folder;
  LinesJob job;
  job.input = cube_file(folder);
  job.outputs = {folder.file("out.json")};
  job.views.report = folder.file("out.html");
  job.views.picture = folder.file("out.png");
  const LinesReport report = run_lines(job);
  EXPECT_FALSE(report.detection.labels.spectrum);
  const test::ReportFile file(TemporaryFolder::read(job.views.report));
  EXPECT_EQ(file.facts.at("graph"), nlohmann::json::parse(TemporaryFolder::read(folder.file("out.json"))));
  EXPECT_EQ(file.facts.at("method"), "gauss");
  EXPECT_EQ(file.numbers("counts").size(), 65521U * 7);
  EXPECT_TRUE(file.facts.at("times").contains("lines"));
  // Without a drawing, and of labels that came with the input.
  DetectJob labelling;
  labelling.input = job.input;
  labelling.output = folder.file("labels.ply");
  (void)run_detect(labelling);
  job.input = labelling.output;
  job.outputs.clear();
  (void)run_lines(job);
  const test::ReportFile again(TemporaryFolder::read(job.views.report));
  EXPECT_EQ(again.facts.at("method"), nullptr);
  EXPECT_EQ(again.facts.at("graph"), file.facts.at("graph"));
}

TEST_F(PipelineViews, AllAppearOrNone) {
  const TemporaryFolder folder;
  DetectJob job;
  job.input = cube_file(folder);
  job.output = folder.file("out.ply");
  job.views.report = folder.file("out.html");
  job.views.picture = folder.file("out.png");
  const auto refuse = [](const auto&) { throw OutputError("stdout", "full"); };
  EXPECT_THROW((void)run_detect(job, no_progress(), refuse), OutputError);
  EXPECT_EQ(folder.entries(), 1U);
  std::filesystem::create_directory(job.views.picture);
  EXPECT_THROW((void)run_detect(job), OutputError);
  LinesJob lines;
  lines.input = job.input;
  lines.outputs = {folder.file("out.obj")};
  lines.views = job.views;
  EXPECT_THROW((void)run_lines(lines), OutputError);
  EXPECT_EQ(folder.entries(), 2U);
}

TEST_F(PipelineViews, MistakesAreFoundBeforeTheWork) {
  const TemporaryFolder folder;
  const std::string input = cube_file(folder);
  const auto refused = [&](const std::string& output, const Views& views, std::string_view part) {
    DetectJob job;
    job.input = input;
    job.output = output;
    job.views = views;
    expect_error<InvalidArgument>([&] { (void)run_detect(job); }, part);
    LinesJob lines;
    lines.input = input;
    if (!output.empty()) lines.outputs = {folder.file("out.obj")};
    lines.views = views;
    expect_error<InvalidArgument>([&] { (void)run_lines(lines); }, part);
  };
  refused("", {}, "expected a name that ends in");
  const std::string output = folder.file("out.ply");
  refused(output, {.report = folder.file("a.htm")}, ".html");
  refused(output, {.picture = folder.file("a.jpg")}, ".png");
  refused("", {.report = input}, ".html");
  refused("", {.report = folder.file("x.html"), .picture = folder.file("./x.html")}, ".png");
  std::filesystem::create_symlink("cube.ply", folder.path() / "link.html");
  refused("", {.report = folder.file("link.html")}, "is the input");
  EXPECT_EQ(folder.entries(), 2U);
}

TEST_F(PipelineViews, HostileCloudsStillGiveAPage) {
  const TemporaryFolder folder;
  const char* const clouds[] = {"x,y,z\n", "x,y,z\n1,2,3\n", "x,y,z\nnan,0,0\n",
                                "x,y,z\n1e30,-1e30,1e300\n0,0,0\n1,1,nan\n", "x,y,z\n5,5,5\n5,5,5\n5,5,5\n"};
  for (const char* const cloud : clouds) {
    DetectJob job;
    job.input = folder.write("<script><b>.csv", cloud);
    job.views.report = folder.file("out.html");
    job.views.picture = folder.file("out.png");
    const DetectReport report = run_detect(job);
    const test::ReportFile file(TemporaryFolder::read(job.views.report));
    EXPECT_EQ(file.facts.at("cloud").at("kept"), report.finite_points) << cloud;
    LinesJob lines;
    lines.input = job.input;
    lines.views = job.views;
    (void)run_lines(lines);
    EXPECT_EQ(
        test::ReportFile(TemporaryFolder::read(job.views.report)).facts.at("graph").at("corners").size(), 0U);
  }
}

TEST(Pipeline, AddLabelsChecksTheLength) {
  PointCloud cloud;
  cloud.positions.resize(3);
  FeatureLabels labels;
  labels.kind.resize(2);
  labels.score.resize(2);
  EXPECT_THROW(add_labels(cloud, labels), InvalidArgument);
}

TEST(Pipeline, LabelsWithoutScoresLeaveTheScore) {
  PointCloud cloud;
  cloud.positions.resize(1);
  FeatureLabels labels;
  labels.kind = {Kind::Edge};
  labels.clusters = {2};
  labels.score = {41.5F};
  EXPECT_TRUE(add_labels(cloud, labels).empty());
  labels.score.clear();
  labels.kind = {Kind::Flat};
  EXPECT_EQ(add_labels(cloud, labels), (std::vector<std::string>{"feature", "kind", "clusters"}));
  EXPECT_EQ(cloud.attribute("score")->value(0), 41.5);
  EXPECT_EQ(cloud.attribute("feature")->value(0), 0);
}

}  // namespace
}  // namespace keenline
