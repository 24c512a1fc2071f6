#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "keenline/report/camera.h"
#include "keenline/report/image.h"

namespace CLI {
class App;
}

namespace keenline::cli {

class TerminalProgress;

/// What every command that draws takes: it draws one picture or several on one sheet.
struct SheetArguments {
  std::string output;
  std::string view;
  std::string size;
  int columns = 0;  // 0: as square as it gets
  std::vector<std::string> captions;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

struct Size {
  int width = 0;
  int height = 0;
};

void add_sheet_options(CLI::App& command, SheetArguments& arguments, const Camera& camera, Size size);

/// --view, or `standard`. \throw InvalidArgument
[[nodiscard]] Camera parsed_view(const SheetArguments& arguments, const Camera& standard);
/// --size, or `standard`. \throw InvalidArgument
[[nodiscard]] Size parsed_size(const SheetArguments& arguments, Size standard);
/// Caption of picture `i`, or nothing. \throw InvalidArgument when there are more captions than pictures.
[[nodiscard]] std::optional<std::string> caption_of(const SheetArguments& arguments, std::size_t i,
                                                    std::size_t pictures);

/// Writes the pictures and says so.
void write_sheet(const SheetArguments& arguments, const std::vector<Image>& pictures,
                 const std::vector<std::string>& inputs, TerminalProgress& progress);

}  // namespace keenline::cli
