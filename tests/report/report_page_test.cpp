#include "keenline/report/report_page.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/io/graph_json.h"
#include "keenline/io/sink.h"
#include "keenline/report/report_data.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"
#include "support/report_file.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

using nlohmann::json;
using test::expect_error;

constexpr std::string_view small_page =
    "<!doctype html><body>\n<!-- keenline report data -->\n<script>run()</script>\n";

ReportData two_points() {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {1, 2, 3}};
  FeatureLabels labels;
  labels.kind = {Kind::Edge, Kind::Flat};
  labels.score = {30, 2};
  return report_data(cloud, labels);
}

ReportFacts facts_of_gauss() {
  ReportFacts facts;
  facts.command = "detect";
  facts.input = "data/scan.ply";
  facts.format = "ply";
  facts.points = 2;
  facts.method = &find_method("gauss");
  facts.options = resolve_options(*facts.method, {{"sigma", 20.0}});
  facts.spacing = 0.25;
  facts.noise = 0.5;
  facts.sigma_deg = 20;
  facts.sigma_rule = "given";
  facts.times_s = {{"read", 0.5}, {"detect", 1.5}};
  facts.notes = {"a note"};
  return facts;
}

std::string html(const ReportFacts& facts, const ReportData& data, const FeatureGraph* lines = nullptr,
                 std::string_view page = small_page) {
  StringSink sink;
  write_report(page, facts, data, lines, sink);
  return sink.text;
}

TEST(ReportPage, TheFactsAreThoseOfTheRun) {
  const ReportData data = two_points();
  const json facts = test::ReportFile(html(facts_of_gauss(), data)).facts;
  EXPECT_EQ(facts.at("format"), "keenline report");
  EXPECT_EQ(facts.at("version"), 1);
  EXPECT_EQ(facts.at("title"), "scan.ply");
  EXPECT_EQ(facts.at("command"), "detect");
  EXPECT_EQ(facts.at("method"), "gauss");
  EXPECT_EQ(facts.at("input").at("path"), "data/scan.ply");
  EXPECT_EQ(facts.at("spacing"), 0.25);
  EXPECT_EQ(facts.at("noise"), 0.5);
  EXPECT_EQ(facts.at("sigma_deg"), 20);
  EXPECT_EQ(facts.at("sigma_rule"), "given");
  EXPECT_EQ(facts.at("options").at("sigma"), 20);
  EXPECT_EQ(facts.at("options").at("min-cluster"), "auto");
  EXPECT_EQ(facts.at("options").at("thin"), true);
  EXPECT_EQ(facts.at("times"), (json{{"read", 0.5}, {"detect", 1.5}}));
  EXPECT_EQ(facts.at("notes"), json::array({"a note"}));
  EXPECT_EQ(facts.at("cloud").at("kept"), 2);
  EXPECT_EQ(facts.at("cloud").at("step"), data.grid.step);
  EXPECT_EQ(facts.at("kinds").at(2),
            (json{{"name", "edge"}, {"number", 2}, {"color", "#d55e00"}, {"count", 1}}));
  EXPECT_EQ(facts.at("kinds").at(6).at("number"), 255);
  EXPECT_EQ(facts.at("truth"), nullptr);
  EXPECT_EQ(facts.at("graph"), nullptr);
}

TEST(ReportPage, LabelsOfTheInputHaveNoMethod) {
  ReportFacts given = facts_of_gauss();
  given.method = nullptr;
  given.sigma_rule = {};
  given.sigma_deg = 0;
  const json facts = test::ReportFile(html(given, two_points())).facts;
  for (const char* const name : {"method", "noise", "sigma_deg", "sigma_rule"})
    EXPECT_EQ(facts.at(name), nullptr) << name;
  EXPECT_EQ(facts.at("options"), json::object());
}

TEST(ReportPage, EveryBufferIsWhereTheFactsSay) {
  const ReportData data = two_points();
  const test::ReportFile file(html(facts_of_gauss(), data));
  std::size_t bytes = 0;
  for (const ReportBuffer& buffer : data.buffers) {
    EXPECT_EQ(file.numbers(buffer.name), test::decoded(buffer)) << buffer.name;
    bytes += buffer.bytes.size();
  }
  EXPECT_EQ(file.data.size(), bytes);
}

TEST(ReportPage, LinesAreThoseOfADrawing) {
  const FeatureGraph graph = test::sample_graph();
  const json facts = test::ReportFile(html(facts_of_gauss(), two_points(), &graph)).facts;
  EXPECT_EQ(facts.at("graph"), json::parse(test::written(write_graph_json, graph)));
}

TEST(ReportPage, NothingThatAFileContainsLeavesItsElement) {
  ReportFacts facts = facts_of_gauss();
  facts.input = "x/<img src=x onerror=alert(1)></script><script>alert(1)</script>.ply";
  facts.encoding = "\xff\xfe not UTF-8 \x01 \"quoted\" \\";
  facts.notes = {"<!-- keenline report data -->", "<!--<script>"};
  ReportData data = two_points();
  data.attributes[0].name = "</script>";
  data.truth = "<b>";
  FeatureGraph graph;
  graph.crs = "</script><script>alert(2)</script>";
  const std::string text = html(facts, data, &graph);
  const test::ReportFile file(text);
  EXPECT_EQ(file.facts.at("input").at("path"), facts.input);
  EXPECT_EQ(file.facts.at("title"), "script>.ply");
  EXPECT_EQ(file.facts.at("graph").at("crs"), graph.crs);
  EXPECT_EQ(file.facts.at("attributes").at(0).at("name"), "</script>");
  // What is left of the page without the facts is the page: nothing else opens or closes an element.
  const std::string_view inside = test::element(text, R"(id="keenline-facts">)");
  EXPECT_EQ(inside.find_first_of("<>&"), std::string_view::npos);
  EXPECT_TRUE(text.starts_with("<!doctype html><body>\n<script type=\"application/json\""));
  EXPECT_TRUE(text.ends_with("</script>\n<script>run()</script>\n"));
  EXPECT_EQ(text.find("alert(1)<"), std::string::npos);
}

TEST(ReportPage, NumbersThatAreNoneAreNull) {
  ReportFacts facts = facts_of_gauss();
  facts.spacing = std::numeric_limits<double>::infinity();
  facts.noise = std::numeric_limits<double>::quiet_NaN();
  const json read = test::ReportFile(html(facts, two_points())).facts;
  EXPECT_EQ(read.at("spacing"), nullptr);
  EXPECT_EQ(read.at("noise"), nullptr);
}

TEST(ReportPage, NoPointIsAReportToo) {
  const test::ReportFile file(html(facts_of_gauss(), report_data({}, {})));
  EXPECT_EQ(file.facts.at("cloud").at("kept"), 0);
  EXPECT_EQ(file.data, "");
}

TEST(ReportPage, APageHasItsMarkerOnce) {
  const ReportData data = two_points();
  expect_error<InvalidArgument>([&] { (void)html(facts_of_gauss(), data, nullptr, "<html>"); }, "marker");
  const std::string twice = std::string(small_page) + std::string(small_page);
  expect_error<InvalidArgument>([&] { (void)html(facts_of_gauss(), data, nullptr, twice); }, "marker");
}

TEST(ReportPage, TheBuiltOneTakesTheDataAndAsksForNothing) {
  if (report_page().empty()) GTEST_SKIP() << "built without the page";
  const std::string text = html(facts_of_gauss(), two_points(), nullptr, report_page());
  EXPECT_EQ(test::ReportFile(text).facts.at("cloud").at("kept"), 2);
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(text.find(" src=\""), std::string::npos);
  EXPECT_EQ(text.find("<link"), std::string::npos);
}

TEST(ReportPage, NamesEndInHtml) {
  for (const char* const path : {"scan.htm", "scan", ".html", "scan.html.png"})
    expect_error<InvalidArgument>([&] { require_writable_report(path); }, ".html");
  if (report_page().empty())
    expect_error<InvalidArgument>([] { require_writable_report("scan.html"); }, "KEENLINE_REPORT");
  else EXPECT_NO_THROW(require_writable_report("scan.HTML"));
}

TEST(ReportPage, IsCancelled) {
  test::CancelledProgress cancelled;
  StringSink sink;
  EXPECT_THROW(write_report(small_page, facts_of_gauss(), two_points(), nullptr, sink, cancelled), Cancelled);
}

}  // namespace
}  // namespace keenline
