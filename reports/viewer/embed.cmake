# Writes a script into a C++ source as a string: cmake -DSCRIPT=FILE -DFUNCTION=NAME -DSOURCE=FILE -P embed.cmake
# SCRIPT is ASCII, and has no `)script"` in it. An empty SCRIPT makes an empty string.
set(text "")
if(SCRIPT)
  file(READ "${SCRIPT}" text)
endif()
file(CONFIGURE OUTPUT "${SOURCE}" @ONLY CONTENT [[
#include "reports/viewer/scripts.hpp"

namespace cbc3d::reports {

std::string_view @FUNCTION@() {
  return R"script(@text@)script";
}

}  // namespace cbc3d::reports
]])
