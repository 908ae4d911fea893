#include "reports/history/date.hpp"

#include <array>
#include <regex>
#include <string>

namespace cbc3d::reports {
namespace {

/// Digits alone, by the pattern.
int part(const std::smatch& parts, std::size_t number) {
  return parts[number].matched ? std::stoi(parts[number].str()) : 0;
}

/// "+01:30" as seconds east of Greenwich.
long zone_seconds(const std::smatch& parts, std::size_t sign) {
  const long seconds = 3600L * part(parts, sign + 1) + 60L * part(parts, sign + 2);
  return parts[sign] == "-" ? -seconds : seconds;
}

/// False for the 31st of April and the like, which timegm takes for the next month.
bool is_same(const std::tm& given, std::time_t seconds) {
  std::tm normal{};
  ::gmtime_r(&seconds, &normal);
  return normal.tm_mday == given.tm_mday && normal.tm_mon == given.tm_mon &&
         normal.tm_hour == given.tm_hour && normal.tm_min == given.tm_min && normal.tm_sec == given.tm_sec;
}

}  // namespace

std::string utc_text(std::time_t seconds) {
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::optional<std::string> parse_date(const std::string& text) {
  static const std::regex form(
      R"((\d{4})-(\d{2})-(\d{2})(?:[T ](\d{2}):(\d{2})(?::(\d{2})(?:\.\d{1,9})?)?(?:Z|([+-])(\d{2}):?(\d{2}))?)?)");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) {
    return std::nullopt;
  }
  std::tm given{};
  given.tm_year = part(parts, 1) - 1900;
  given.tm_mon = part(parts, 2) - 1;
  given.tm_mday = part(parts, 3);
  given.tm_hour = part(parts, 4);
  given.tm_min = part(parts, 5);
  given.tm_sec = part(parts, 6);
  std::tm copy = given;
  const std::time_t seconds = ::timegm(&copy);
  return is_same(given, seconds) ? std::optional(utc_text(seconds - zone_seconds(parts, 7))) : std::nullopt;
}

}  // namespace cbc3d::reports
