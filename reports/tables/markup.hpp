// Text made safe for the places it is put in.
#pragma once

#include <string>

namespace cbc3d::reports {

std::string replace_all(std::string text, const std::string& from, const std::string& to);

/// For HTML and XML, in text and in double-quoted attributes; control characters become blanks.
std::string markup_text(const std::string& text);

/// For a cell of a Markdown table: on one line, closing no cell.
std::string markdown_text(const std::string& text);

/// Base64 (RFC 4648), for data in HTML.
std::string base64(const std::string& bytes);

}  // namespace cbc3d::reports
