#include "keenline/io/ply_header.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

struct TypeName {
  std::string_view name;
  ScalarType type;
};

// The names of the format's first description come first: they are the ones that every program reads.
constexpr std::array type_names{
    TypeName{"char", ScalarType::Int8},       TypeName{"uchar", ScalarType::UInt8},
    TypeName{"short", ScalarType::Int16},     TypeName{"ushort", ScalarType::UInt16},
    TypeName{"int", ScalarType::Int32},       TypeName{"uint", ScalarType::UInt32},
    TypeName{"float", ScalarType::Float32},   TypeName{"double", ScalarType::Float64},
    TypeName{"int8", ScalarType::Int8},       TypeName{"uint8", ScalarType::UInt8},
    TypeName{"int16", ScalarType::Int16},     TypeName{"uint16", ScalarType::UInt16},
    TypeName{"int32", ScalarType::Int32},     TypeName{"uint32", ScalarType::UInt32},
    TypeName{"int64", ScalarType::Int64},     TypeName{"uint64", ScalarType::UInt64},
    TypeName{"float32", ScalarType::Float32}, TypeName{"float64", ScalarType::Float64},
};

bool is_float(ScalarType type) { return type == ScalarType::Float32 || type == ScalarType::Float64; }

class HeaderParser {
 public:
  explicit HeaderParser(const Source& source)
      : source_(source),
        start_(source.bytes.size() - without_bom(source.bytes).size()),
        text_(source.bytes.substr(start_, longest_ply_header)),
        lines_(text_) {}

  PlyHeader parse() {
    next_line();
    if (take() != "ply") refuse(line_.empty() ? "an empty line" : quoted(line_), "'ply'");
    expect_line_end();
    while (parse_line()) continue;
    if (!has_format_) refuse("no format line in the header", "'format ascii 1.0' or another format");
    header_.size = start_ + (text_.size() - lines_.rest().size());
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(std::string_view found, std::string_view expected) const {
    throw InputError(source_.name, Place::line(std::max<std::uint64_t>(1, lines_.number())), found, expected);
  }

  void next_line() {
    if (!lines_.next(line_)) refuse(text_.empty() ? "an empty file" : "the end of the file", expected_line_);
    // What fills all that is looked at may be cut off anywhere.
    if (lines_.rest().empty() && text_.size() == longest_ply_header)
      refuse("a header of more than 32 MiB", expected_line_);
    expected_line_ = "'end_header'";
    if (line_.find('\0') != std::string_view::npos) refuse("a zero byte", "a line of the header");
    rest_ = line_;
  }

  std::string_view take() { return take_word(rest_); }

  std::string_view take(std::string_view expected) {
    const std::string_view word = take();
    if (word.empty()) refuse("the end of the line", expected);
    return word;
  }

  void expect_line_end() {
    const std::string_view word = take();
    if (!word.empty()) refuse(quoted(word), "the end of the line");
  }

  /// False at the end of the header.
  bool parse_line() {
    next_line();
    const std::string_view keyword = take();
    if (keyword == "comment") {
      header_.comments.emplace_back(rest_.substr(std::min<std::size_t>(1, rest_.size())));
    } else if (keyword == "obj_info") {
      header_.comments.push_back("obj_info " +
                                 std::string(rest_.substr(std::min<std::size_t>(1, rest_.size()))));
    } else if (keyword == "property") {
      parse_property();
    } else if (keyword == "element") {
      parse_element();
    } else if (keyword == "format") {
      parse_format();
    } else if (keyword == "end_header") {
      expect_line_end();
      return false;
    } else if (!keyword.empty()) {
      refuse(quoted(keyword), "format, element, property, comment, obj_info or end_header");
    }
    return true;
  }

  void parse_format() {
    if (has_format_) refuse("a second format line", "one");
    has_format_ = true;
    constexpr std::string_view known = "ascii, binary_little_endian or binary_big_endian";
    const std::string_view encoding = take(known);
    if (encoding == "ascii") header_.encoding = PlyEncoding::Ascii;
    else if (encoding == "binary_little_endian") header_.encoding = PlyEncoding::LittleEndian;
    else if (encoding == "binary_big_endian") header_.encoding = PlyEncoding::BigEndian;
    else refuse(quoted(encoding), known);
    const std::string_view version = take("1.0");
    if (version != "1.0") refuse("version " + quoted(version), "1.0");
    expect_line_end();
  }

  void parse_element() {
    PlyElement element;
    element.name = take("the name of an element");
    element.line = lines_.number();
    const std::string_view count = take("the number of rows");
    const char* const end = count.data() + count.size();
    const auto result = std::from_chars(count.data(), end, element.count);
    if (result.ptr != end || result.ec != std::errc())
      refuse(fmt::format("{} rows of element {}", quoted(count), quoted(element.name)), "a number from 0");
    expect_line_end();
    if (!element_names_.insert(element.name).second)
      refuse("a second element " + quoted(element.name), "each name once");
    property_names_.clear();
    header_.elements.push_back(std::move(element));
  }

  ScalarType take_type() {
    const std::string_view word = take("a type");
    const auto found =
        std::find_if(type_names.begin(), type_names.end(), [&](const TypeName& t) { return t.name == word; });
    if (found == type_names.end())
      refuse(quoted(word), "a type: char, uchar, short, ushort, int, uint, float or double");
    return found->type;
  }

  void parse_property() {
    if (header_.elements.empty()) refuse("a property before any element", "an element first");
    PlyProperty property;
    property.line = lines_.number();
    std::string_view after_list = rest_;
    if (take_word(after_list) == "list") {
      rest_ = after_list;
      property.count_type = take_type();
      if (is_float(*property.count_type)) refuse("a list whose length is a float", "an integer type");
    }
    property.type = take_type();
    property.name = take("the name of a property");
    expect_line_end();
    PlyElement& element = header_.elements.back();
    if (!property_names_.insert(property.name).second) {
      refuse(fmt::format("a second property {} of element {}", quoted(property.name), quoted(element.name)),
             "each name once");
    }
    element.properties.push_back(std::move(property));
  }

  const Source& source_;
  std::size_t start_;
  std::string_view text_;
  LineReader lines_;
  std::string_view line_;
  std::string_view rest_;  // of the line
  std::string_view expected_line_ = "'ply'";
  bool has_format_ = false;
  std::set<std::string> element_names_;
  std::set<std::string> property_names_;  // of the element that is being declared
  PlyHeader header_;
};

}  // namespace

std::string_view name_of(PlyEncoding encoding) {
  switch (encoding) {
    case PlyEncoding::Ascii: return "ascii 1.0";
    case PlyEncoding::LittleEndian: return "binary little endian 1.0";
    case PlyEncoding::BigEndian: break;
  }
  return "binary big endian 1.0";
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.count_type.has_value(); });
}

const PlyProperty* PlyElement::property(std::string_view wanted) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == wanted; });
  return found == properties.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(const Source& source) { return HeaderParser(source).parse(); }

std::string_view ply_type_name(ScalarType type) {
  const auto found =
      std::find_if(type_names.begin(), type_names.end(), [&](const TypeName& t) { return t.type == type; });
  assert(found != type_names.end());
  return found->name;
}

}  // namespace keenline
