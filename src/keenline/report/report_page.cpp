#include "keenline/report/report_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/graph_json.h"
#include "keenline/io/sink.h"
#include "keenline/io/text.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/report/legend.h"
#include "keenline/report/report_data.h"
#include "keenline/report/report_sinks.h"

namespace keenline {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view marker = "<!-- keenline report data -->";

Json json_of(const ReportBuffer& buffer, std::size_t offset) {
  return {
      {"name", buffer.name},         {"type", name_of(buffer.type)},     {"components", buffer.components},
      {"count", buffer.count},       {"coding", name_of(buffer.coding)}, {"offset", offset},
      {"bytes", buffer.bytes.size()}};
}

Json json_of_input(const ReportFacts& facts) {
  return {{"name", facts.input.substr(facts.input.rfind('/') + 1)},
          {"path", facts.input},
          {"format", facts.format},
          {"encoding", facts.encoding},
          {"points", facts.points},
          {"finite_points", facts.finite_points}};
}

Json json_of_options(const ReportFacts& facts) {
  Json object = Json::object();
  if (facts.method == nullptr) return object;
  for (const OptionInfo& option : facts.method->options) {
    std::visit([&](const auto& value) { object[std::string(option.name)] = value; },
               told_value(option, facts.options.at(std::string(option.name))));
  }
  return object;
}

Json json_of_kinds(const KindCounts& counts) {
  Json list = Json::array();
  for (std::size_t i = 0; i < all_kinds.size(); ++i) {
    const Color color = color_of(all_kinds[i]);
    list.push_back({{"name", name_of(all_kinds[i])},
                    {"number", static_cast<int>(all_kinds[i])},
                    {"color", fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue)},
                    {"count", counts[i]}});
  }
  return list;
}

/// All of them but the lines.
Json json_of(const ReportFacts& facts, const ReportData& data) {
  Json input = json_of_input(facts);
  Json object{{"format", "keenline report"},
              {"version", 1},
              {"title", input["name"]},
              {"program", "keenline " KEENLINE_VERSION},
              {"command", facts.command},
              {"method", nullptr},
              {"input", std::move(input)},
              {"spacing", facts.spacing},
              {"noise", nullptr},
              {"smoothed", facts.smoothed},
              {"sigma_deg", nullptr},
              {"sigma_rule", nullptr},
              {"options", json_of_options(facts)},
              {"times", Json::object()},
              {"notes", facts.notes},
              {"cloud",
               {{"kept", data.kept},
                {"left_out", data.left_out},
                {"origin", data.grid.origin},
                {"step", data.grid.step}}},
              {"kinds", json_of_kinds(data.kind_counts)},
              {"units_per_degree", kernels::angle_units_per_degree},
              {"truth", nullptr},
              {"buffers", Json::array()},
              {"attributes", Json::array()}};
  if (facts.method != nullptr) {
    object["method"] = facts.method->name;
    object["noise"] = facts.noise;
  }
  if (facts.sigma_deg > 0) object["sigma_deg"] = facts.sigma_deg;
  if (!facts.sigma_rule.empty()) object["sigma_rule"] = facts.sigma_rule;
  for (const auto& [stage, seconds] : facts.times_s) object["times"][std::string(stage)] = seconds;
  if (!data.truth.empty()) object["truth"] = data.truth;
  std::size_t offset = 0;
  for (const ReportBuffer& buffer : data.buffers) {
    object["buffers"].push_back(json_of(buffer, offset));
    offset += buffer.bytes.size();
  }
  for (const ReportAttribute& a : data.attributes)
    object["attributes"].push_back(
        {{"name", a.name}, {"buffer", a.buffer}, {"low", a.low}, {"high", a.high}, {"step", a.step}});
  return object;
}

void write_facts(const ReportFacts& facts, const ReportData& data, const FeatureGraph* lines, Sink& sink,
                 Progress& progress) {
  HtmlJsonSink escaping(sink);
  std::string text = json_of(facts, data).dump(-1, ' ', false, Json::error_handler_t::replace);
  text.back() = ',';  // in place of the closing brace
  escaping.write(text);
  escaping.write(R"("graph":)");
  if (lines == nullptr) escaping.write("null");
  else write_graph_json(*lines, escaping, progress);
  escaping.write("}");
}

void write_data(const ReportData& data, Sink& sink, Progress& progress) {
  Base64Sink digits(sink);
  ZlibSink packed(digits);
  for (const ReportBuffer& buffer : data.buffers) {
    constexpr std::size_t part = std::size_t{1} << 20U;
    for (std::size_t at = 0; at < buffer.bytes.size(); at += part) {
      progress.check();
      packed.write(std::string_view(buffer.bytes).substr(at, part));
      progress.advance(std::min(part, buffer.bytes.size() - at));
    }
  }
  packed.finish();
  digits.finish();
}

}  // namespace

void require_writable_report(std::string_view path) {
  constexpr std::string_view extension = ".html";
  if (path.size() <= extension.size() ||
      !starts_with_ignoring_case(path.substr(path.size() - extension.size()), extension))
    throw InvalidArgument(fmt::format("report {}: expected a name that ends in .html", quoted(path, 4096)));
  if (report_page().empty())
    throw InvalidArgument("--report: this program was built without the page (KEENLINE_REPORT=OFF)");
}

void write_report(std::string_view page, const ReportFacts& facts, const ReportData& data,
                  const FeatureGraph* lines, Sink& sink, Progress& progress) {
  const std::size_t at = page.find(marker);
  if (at == std::string_view::npos || page.find(marker, at + 1) != std::string_view::npos)
    throw InvalidArgument(fmt::format("the page of a report: expected the marker {} once", quoted(marker)));
  std::uint64_t total = 0;
  for (const ReportBuffer& buffer : data.buffers) total += buffer.bytes.size();
  progress.begin("report", total);
  sink.write(page.substr(0, at));
  sink.write("<script type=\"application/json\" id=\"keenline-facts\">");
  write_facts(facts, data, lines, sink, progress);
  sink.write("</script>\n<script type=\"text/plain\" id=\"keenline-data\">");
  write_data(data, sink, progress);
  sink.write("</script>");
  sink.write(page.substr(at + marker.size()));
}

}  // namespace keenline
