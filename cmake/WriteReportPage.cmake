# A C++ source SOURCE that holds the file PAGE as one raw string; an empty one without PAGE.
set(text "")
if(PAGE)
  file(READ "${PAGE}" text)
endif()
string(FIND "${text}" ")keenline-page\"" end)
if(NOT end EQUAL -1)
  message(FATAL_ERROR "${PAGE} holds the end mark of the string that is to hold it")
endif()
file(WRITE "${SOURCE}" "#include \"keenline/report/report_page.h\"

std::string_view keenline::report_page() {
  static constexpr char page[] = R\"keenline-page(${text})keenline-page\";
  return {page, sizeof page - 1};
}
")
