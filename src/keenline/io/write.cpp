#include "keenline/io/write.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/csv.h"
#include "keenline/io/output_file.h"
#include "keenline/io/ply.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

struct Writer {
  std::string_view extension;
  std::vector<std::string> (*write)(const PointCloud& cloud, Sink& sink, Progress& progress);
  bool holds_lists;  // of varying length
};

constexpr std::array writers{Writer{".ply", write_ply, true}, Writer{".csv", write_csv, false}};

const Writer& find_writer(std::string_view path) {
  const auto found = std::find_if(writers.begin(), writers.end(), [&](const Writer& writer) {
    return path.size() > writer.extension.size() &&
           starts_with_ignoring_case(path.substr(path.size() - writer.extension.size()), writer.extension);
  });
  if (found == writers.end())
    throw InvalidArgument(
        fmt::format("output {}: expected a name that ends in .ply or .csv", quoted(path, 4096)));
  return *found;
}

}  // namespace

void require_writable_extension(std::string_view path) { (void)find_writer(path); }

bool holds_lists(std::string_view path) { return find_writer(path).holds_lists; }

std::vector<std::string> write_cloud(const std::string& path, const PointCloud& cloud, Progress& progress,
                                     const BeforeCommit& before_commit) {
  const Writer& writer = find_writer(path);
  progress.begin("writing", cloud.size());
  OutputFile file(path);
  std::vector<std::string> notes = writer.write(cloud, file, progress);
  file.store();
  progress.check();
  if (before_commit) before_commit(notes);
  file.commit();
  return notes;
}

}  // namespace keenline
