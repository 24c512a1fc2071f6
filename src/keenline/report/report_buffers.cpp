#include "keenline/report/report_buffers.h"

#include <utility>

namespace keenline {
std::string_view name_of(BufferCoding coding) {
  switch (coding) {
    case BufferCoding::Raw: return "raw";
    case BufferCoding::Planes: return "planes";
    case BufferCoding::Delta: break;
  }
  return "delta";
}

template <typename T>
ReportBuffer encoded(std::string name, std::span<const T> values, std::size_t components,
                     BufferCoding coding) {
  const std::size_t count = values.size() / components;
  ReportBuffer buffer{std::move(name), scalar_type_of<T>(),
                      components,      count,
                      coding,          std::string(values.size() * sizeof(T), '\0')};
  for (std::size_t c = 0; c < components; ++c) {
    T before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = i * components + c;
      T value = values[place];
      if (coding == BufferCoding::Delta) value = folded(static_cast<T>(value - std::exchange(before, value)));
      for (std::size_t b = 0; b < sizeof(T); ++b) {
        const std::size_t at =
            coding == BufferCoding::Raw ? place * sizeof(T) + b : (c * sizeof(T) + b) * count + i;
        buffer.bytes[at] = static_cast<char>(static_cast<unsigned char>(value >> (8 * b)));
      }
    }
  }
  return buffer;
}

template ReportBuffer encoded(std::string, std::span<const std::uint8_t>, std::size_t, BufferCoding);
template ReportBuffer encoded(std::string, std::span<const std::uint16_t>, std::size_t, BufferCoding);
template ReportBuffer encoded(std::string, std::span<const std::uint32_t>, std::size_t, BufferCoding);

}  // namespace keenline
