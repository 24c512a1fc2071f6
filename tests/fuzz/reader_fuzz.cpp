// Any bytes either make a cloud that can be written and read back, or are refused with an InputError; nothing
// else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "keenline/errors.h"
#include "keenline/io/formats.h"
#include "keenline/io/ply.h"
#include "keenline/io/sink.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

namespace {

using keenline::Format;

const Format& fuzzed_format() {
  for (const Format& format : keenline::formats())
    if (format.name == KEENLINE_FUZZ_FORMAT) return format;
  std::abort();
}

void require(bool fact) {
  if (!fact) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const keenline::Source source{"fuzz", {reinterpret_cast<const char*>(data), size}};
  (void)keenline::find_format({"fuzz." KEENLINE_FUZZ_FORMAT, source.bytes});
  keenline::Reading reading;
  try {
    reading = fuzzed_format().read(source, keenline::no_progress());
  } catch (const keenline::InputError& e) {
    require(std::string_view(e.what()).find('\n') == std::string_view::npos);
    return 0;
  }
  for (const keenline::Column& column : reading.cloud.attributes)
    require(column.rows() == reading.cloud.size());
  keenline::StringSink sink;
  (void)keenline::write_ply(reading.cloud, sink, keenline::no_progress());
  const keenline::Reading back = keenline::read_ply({"back", sink.text}, keenline::no_progress());
  require(back.cloud.size() == reading.cloud.size());
  return 0;
}
