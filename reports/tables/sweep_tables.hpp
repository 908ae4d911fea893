// The tables of a sweep over threads. Without rows when the run is no sweep.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `sweep`: for every case, mesher and thread count median with its interval and range of the time,
/// speed-up with its interval and whether the rank test tells it from 1, efficiency, and outliers.
Table sweep_table(const TableInput& input);

/// Table `sweep_stages`: the same of every stage, with its share of the job.
Table sweep_stage_table(const TableInput& input);

}  // namespace cbc3d::reports
