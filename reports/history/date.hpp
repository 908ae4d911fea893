// Points of time as texts whose order is that of time.
#pragma once

#include <ctime>
#include <optional>
#include <string>

namespace cbc3d::reports {

/// "2026-11-29T08:05:09Z".
std::string utc_text(std::time_t seconds);

/// ISO 8601 as UTC: "2026-11-29", "2026-11-29T09:05:09+01:00" or with Z; a time without a zone is UTC. None
/// where the text is no date.
std::optional<std::string> parse_date(const std::string& text);

}  // namespace cbc3d::reports
