// The written forms of a verdict.
#include <algorithm>

#include "reports/gate/gate.hpp"
#include "reports/tables/markup.hpp"

namespace cbc3d::reports {
namespace {

/// GitHub's way of putting a text on one line of its commands.
std::string escaped_command(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '%' ? "%25" : c == '\n' ? "%0A" : c == '\r' ? "%0D" : std::string(1, c);
  }
  return escaped;
}

std::string known_count(const Verdict& verdict) {
  const std::size_t fail = verdict.count(Known::fails), pass = verdict.count(Known::passes);
  return (fail > 0 ? ", " + std::to_string(fail) + " known to fail" : "") +
         (pass > 0 ? ", " + std::to_string(pass) + " known to fail and pass" : "");
}

std::string count_line(const Verdict& verdict) {
  return std::to_string(verdict.checks.size()) + " checks, " + std::to_string(verdict.fallen()) + " fell" +
         known_count(verdict) + (verdict.holds() ? ": the gate holds" : ": the gate does not hold");
}

}  // namespace

std::string to_text(const Verdict& verdict) {
  std::string text;
  for (const Check& check : verdict.checks) {
    text += check.fell ? "FELL    " + check.job + ": " + check.text + "\n" : "";
  }
  for (const Check& check : verdict.checks) {
    text += check.known == Known::fails    ? "known   " + check.job + ": " + check.text + "\n"
            : check.known == Known::passes ? "passes  " + check.job + ": " + check.text + "\n"
                                           : "";
  }
  for (const Check& check : verdict.checks) {
    text += check.better ? "better  " + check.job + ": " + check.text + "\n" : "";
  }
  for (const std::string& note : verdict.notes) {
    text += "note    " + note + "\n";
  }
  return text + count_line(verdict) + "\n";
}

std::string to_junit(const Verdict& verdict) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"cbc3d-bench gate\" "
      "tests=\"" +
      std::to_string(verdict.checks.size()) + "\" failures=\"" + std::to_string(verdict.fallen()) +
      "\" errors=\"0\" skipped=\"" + std::to_string(verdict.count(Known::fails)) + "\">\n";
  for (const Check& check : verdict.checks) {
    text +=
        "  <testcase classname=\"" + markup_text(check.job) + "\" name=\"" + markup_text(check.figure) + "\"";
    const char* kind = check.fell ? "failure" : check.known == Known::fails ? "skipped" : nullptr;
    text += kind != nullptr
                ? "><" + std::string(kind) + " message=\"" + markup_text(check.text) + "\"/></testcase>\n"
                : "/>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

std::string to_step_summary(const Verdict& verdict) {
  std::string text = "### cbc3d-bench gate\n\n" + count_line(verdict) + "\n";
  const auto is_named = [](const Check& check) { return check.fell || check.known != Known::no; };
  if (std::any_of(verdict.checks.begin(), verdict.checks.end(), is_named)) {
    text += "\n| job | figure | finding |\n|---|---|---|\n";
  }
  for (const Check& check : verdict.checks) {
    if (is_named(check)) {
      text +=
          "| " + markdown_text(check.job) + " | " + check.figure + " | " + markdown_text(check.text) + " |\n";
    }
  }
  return text;
}

std::string to_annotations(const Verdict& verdict) {
  std::string text;
  for (const Check& check : verdict.checks) {
    text += check.fell
                ? "::error title=cbc3d-bench gate::" + escaped_command(check.job + ": " + check.text) + "\n"
                : "";
  }
  return text;
}

}  // namespace cbc3d::reports
