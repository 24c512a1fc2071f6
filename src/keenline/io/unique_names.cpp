#include "keenline/io/unique_names.h"

#include <fmt/format.h>

namespace keenline {

UniqueNames::UniqueNames(std::initializer_list<std::string_view> taken) {
  for (const std::string_view name : taken) taken_.emplace(name, 2);
}

std::string UniqueNames::claim(const std::string& wanted) {
  if (taken_.emplace(wanted, 2).second) return wanted;
  std::uint64_t number = taken_[wanted];
  std::string name;
  do name = fmt::format("{}_{}", wanted, number++);
  while (!taken_.emplace(name, 2).second);
  taken_[wanted] = number;
  return name;
}

}  // namespace keenline
