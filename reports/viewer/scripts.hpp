// The scripts of the page, put into the program when it is built.
#pragma once

#include <string_view>

namespace cbc3d::reports {

/// page/sort_tables.js: tables of the class `sortable`.
std::string_view sort_tables_script();
/// page/live_plots.js: plots within the class `plots`.
std::string_view live_plots_script();
/// view/main.js with all that it needs and its licences; empty where the packages for it were not there when
/// this was built.
std::string_view view_script();

}  // namespace cbc3d::reports
