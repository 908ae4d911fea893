// Warnings as the screen shows them: what is said of many labels is said once.
#pragma once

#include <string>
#include <vector>

namespace cbc3d {

/// The warnings in their order, those that differ in their numbers alone as one: the first, and how many
/// others there are. Those at most that are three of a kind stay as they are.
std::vector<std::string> grouped_warnings(const std::vector<std::string>& warnings);

}  // namespace cbc3d
