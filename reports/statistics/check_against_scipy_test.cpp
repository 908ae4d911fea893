// The figures of this room against scipy's, by the script check_against_scipy. Skipped where scipy is absent.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <random>
#include <sstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/statistics/bootstrap.hpp"
#include "reports/statistics/rank_test.hpp"

namespace cbc3d::reports {
namespace {

std::string list(const std::vector<double>& values) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const double value : values) text << (text.tellp() > 0 ? ", " : "[") << value;
  return text.str() + "]";
}

std::string list(const std::optional<Interval>& interval) {
  return list(std::vector<double>{interval.value().low, interval.value().high});
}

/// What the room makes of two samples. `count_all`: small enough for each permutation to be counted.
std::string entry(const std::vector<double>& a, const std::vector<double>& b, bool count_all) {
  std::ostringstream text;
  text << std::setprecision(17) << "{\"a\": " << list(a) << ", \"b\": " << list(b)
       << ", \"count_all\": " << (count_all ? "true" : "false") << ", \"exact_p\": " << mann_whitney_p(a, b)
       << ", \"normal_p\": " << mann_whitney_normal_p(a, b) << ", \"effect\": " << vargha_delaney_a(a, b)
       << ", \"median\": " << list(median_interval(a)) << ", \"ratio\": " << list(median_ratio_interval(a, b))
       << "}";
  return text.str();
}

/// `count` times, rounded to `steps` a second so that some are equal; 0: not rounded.
std::vector<double> times(std::size_t count, double middle, double steps, std::mt19937_64& random) {
  std::lognormal_distribution<double> draw(std::log(middle), 0.2);
  std::vector<double> values(count);
  for (double& value : values) {
    value = draw(random);
    value = steps > 0 ? std::round(value * steps) / steps : value;
  }
  return values;
}

std::string samples() {
  std::mt19937_64 random(5);
  std::string text = "[";
  for (int n = 0; n < 4; ++n) {
    const std::vector<double> base = times(7, 1.2, 4, random);
    text += entry(times(6, 1, 4, random), base, true) + ",\n";                       // ties
    text += entry(times(10, 1.2, 0, random), times(9, 1, 0, random), true) + ",\n";  // none
    text += entry(times(40, 1.1, 10, random), times(30, 1, 10, random), false) + ",\n";
  }
  return text + entry(times(8, 1, 0, random), times(8, 3, 0, random), true) + "]";
}

/// Exit code of the script and what it printed.
std::pair<int, std::string> check(const std::string& json) {
  const cbc3d::testing::TemporaryFolder folder;
  const std::string file = folder.path() / "samples.json", report = folder.path() / "report.txt";
  write_text_file(file, json);
  const std::string command =
      std::string("/usr/bin/python3 ") + CHECK + " " + file + " > " + report + " 2>&1";
  const int code = std::system(command.c_str());
  std::ifstream stream(report);
  return {code, std::string(std::istreambuf_iterator<char>(stream), {})};
}

class AgainstScipy : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import scipy.stats' 2>/dev/null") != 0) {
      GTEST_SKIP() << "python3-scipy is not installed";
    }
  }
};

TEST_F(AgainstScipy, TestsEffectsAndIntervalsAgree) {
  const auto [code, report] = check(samples());
  EXPECT_EQ(code, 0) << report;
  EXPECT_NE(report.find("13 pairs of samples, 0 differences"), std::string::npos) << report;
}

TEST_F(AgainstScipy, AWrongFigureIsFound) {
  std::string json = samples();
  const std::size_t at = json.find("\"exact_p\": ") + 11;
  json.replace(at, json.find(',', at) - at, "0.123");
  const auto [code, report] = check(json);
  EXPECT_NE(code, 0);
  EXPECT_NE(report.find("exact_p: ours 0.123"), std::string::npos) << report;
}

}  // namespace
}  // namespace cbc3d::reports
