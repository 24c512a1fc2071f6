#include "keenline/io/read.h"

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

/// A cloud without points says so in its header; a file that says nothing was never written.
void require_content(const Source& source) {
  const std::string_view text = without_bom(source.bytes);
  if (text.find_first_not_of(" \t\r\n") != std::string_view::npos) return;
  throw InputError(source.name, Place::byte(0), text.empty() ? "an empty file" : "nothing but blanks",
                   "a point cloud");
}

}  // namespace

Reading read_cloud(const std::string& path, Progress& progress) {
  const MappedFile file(path);
  const Source source = file.source();
  require_content(source);
  const Format& format = find_format(source);
  progress.begin("reading", source.bytes.size());
  Reading reading = format.read(source, progress);
  reading.format = format.name;
  return reading;
}

}  // namespace keenline
