// A page of HTML in one file, with its style and its scripts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cbc3d::reports {

/// A part of a page, with a heading and a link to it; without HTML it is left out.
struct PageSection {
  std::string id, name;
  std::string html;
};

/// A page; `title`, `id` and `name` are escaped, HTML is put in as it is. Its tables can be sorted and its
/// plots answer to the mouse. `scripts`: others to run after these, ASCII without "</script". Its policy lets
/// no other script run, and nothing be loaded.
std::string html_page(const std::string& title, const std::string& lead,
                      const std::vector<PageSection>& sections,
                      const std::vector<std::string_view>& scripts = {});

/// <name attributes>content</name>; nothing is escaped.
std::string element(const std::string& name, const std::string& content, const std::string& attributes = "");

}  // namespace cbc3d::reports
