#include "keenline/io/read.h"

#include "keenline/io/source.h"

namespace keenline {

Reading read_cloud(const std::string& path, Progress& progress) {
  const MappedFile file(path);
  const Source source = file.source();
  const Format& format = find_format(source);
  progress.begin("reading", source.bytes.size());
  Reading reading = format.read(source, progress);
  reading.format = format.name;
  return reading;
}

}  // namespace keenline
