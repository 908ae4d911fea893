#include "reports/tables/markup.hpp"

#include <cstdint>
#include <string_view>

namespace cbc3d::reports {

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string markup_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return escaped;
}

std::string markdown_text(const std::string& text) {
  return replace_all(replace_all(text, "\n", " "), "|", "\\|");
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t group = 0;
    for (std::size_t byte = 0; byte < 3; ++byte) {
      group = group << 8U | (n + byte < bytes.size() ? static_cast<unsigned char>(bytes[n + byte]) : 0U);
    }
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += n + digit > bytes.size() ? '=' : kDigits[group >> (18 - 6 * digit) & 63U];
    }
  }
  return text;
}

}  // namespace cbc3d::reports
