// An evaluation in words, for people at a terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace cbc3d::reports {

/// The figures of `evaluation` (metrics/evaluate.hpp, with or without `solver`) that the tables show or the
/// gate compares, section by section; the labels that fare worst; where the topology differs from the
/// image's; the faults; and summary_of, each line with its end.
std::string evaluation_text(const nlohmann::json& evaluation);

/// One line: elements, shape, distance, Dice and volume of the worst labels, topology, faults.
std::string summary_of(const nlohmann::json& evaluation);

}  // namespace cbc3d::reports
