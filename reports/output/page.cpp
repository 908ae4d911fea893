#include "reports/output/page.hpp"

#include <charconv>

#include "cases/core/sha256.hpp"
#include "reports/tables/markup.hpp"
#include "reports/viewer/scripts.hpp"

namespace cbc3d::reports {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, -apple-system, "Segoe UI", sans-serif; color: #1c1e21; background: #fff;
       margin: 0 auto; padding: 1rem; max-width: 76rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0; }
h2 { font-size: 1.3rem; border-bottom: 2px solid #0072b2; margin: 2.2rem 0 .8rem; padding-bottom: .2rem; }
h3 { font-size: 1.05rem; margin: 1.4rem 0 .4rem; }
nav a { display: inline-block; margin: 0 .9rem .2rem 0; }
a { color: #005a8f; }
.scroll { overflow-x: auto; -webkit-overflow-scrolling: touch; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .6rem; border-bottom: 1px solid #d8dbe0; text-align: right; vertical-align: top; }
th { background: #f1f3f6; }
th:nth-child(-n+2), td:nth-child(-n+2), .left td, .left th { text-align: left; }
td.failed { color: #a3240c; }
tbody tr:hover { background: #f7f9fb; }
.notes { font-size: .8rem; color: #444; padding-left: 1.4rem; overflow-wrap: anywhere; }
figure { margin: 0; }
figcaption { font-size: .8rem; color: #444; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)); gap: 1rem; }
.plots svg { width: 100%; height: auto; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 15rem), 1fr)); gap: .8rem; }
.pictures img { width: 100%; height: auto; border: 1px solid #d8dbe0; display: block; }
.badge { display: inline-block; border-radius: .8rem; padding: .05rem .7rem; margin: 0 .4rem .3rem 0; background: #e6e9ed; }
.badge.ok { background: #cfeadb; } .badge.bad { background: #f7d5cc; }
dl { display: grid; grid-template-columns: minmax(7rem, auto) 1fr; gap: .1rem 1rem; font-size: .85rem; }
dt { color: #555; } dd { margin: 0; overflow-wrap: anywhere; }
td code { font-size: .78rem; white-space: nowrap; }
.tip { position: fixed; z-index: 10; pointer-events: none; background: #1c1e21; color: #fff; font-size: .82rem; line-height: 1.35;
       padding: .35rem .6rem; border-radius: .3rem; white-space: pre-line; max-width: min(24rem, calc(100vw - 1rem));
       overflow-wrap: anywhere; }
.marked { stroke: #000; stroke-width: 2px; }
.plots .point:focus { outline: none; }
.series.off { display: none; } .series.faded { opacity: .15; }
.plots .key { cursor: pointer; } .key.off { opacity: .35; } .key.off text { text-decoration: line-through; }
.plots .key:focus-visible { outline: 2px solid #0072b2; }
button.sort { font: inherit; font-weight: bold; color: inherit; background: none; border: 0; margin: 0; padding: 0; cursor: pointer;
              text-align: inherit; }
button.sort:focus-visible { outline: 2px solid #0072b2; outline-offset: 2px; }
button.sort::after { content: "\2195"; opacity: .35; padding-left: .25em; font-weight: normal; }
th[aria-sort=ascending] button.sort::after { content: "\2191"; opacity: 1; }
th[aria-sort=descending] button.sort::after { content: "\2193"; opacity: 1; }
@media (max-width: 40rem) {
  body { padding: .7rem; font-size: 15px; } h1 { font-size: 1.35rem; }
  th:first-child, td:first-child { position: sticky; left: 0; background: #fff; min-width: 6rem; max-width: 9rem;
                                   overflow-wrap: break-word; }
  .plots figure { overflow-x: auto; } .plots svg { min-width: 28rem; }
  dl { grid-template-columns: 1fr; } dd { margin-bottom: .4rem; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; } nav, .tip, #view3d { display: none; } button.sort::after { content: none; }
  .scroll { overflow: visible; } table { font-size: 7.5pt; } td code { font-size: 5.5pt; } th, td { padding: .1rem .25rem; }
  tr, figure, .plots > *, .pictures > * { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .pictures { grid-template-columns: repeat(4, 1fr); } .plots { grid-template-columns: repeat(2, 1fr); }
  a { color: inherit; text-decoration: none; }
}
)";

/// A script's digest as a policy names it.
std::string policy_digest(std::string_view script) {
  const std::string digits = cases::sha256_of_text(script);
  std::string bytes;
  for (std::size_t n = 0; n + 1 < digits.size(); n += 2) {
    unsigned char byte = 0;
    std::from_chars(digits.data() + n, digits.data() + n + 2, byte, 16);
    bytes += static_cast<char>(byte);
  }
  return "'sha256-" + base64(bytes) + "'";
}

/// What the page may do: run these scripts and no others, show what it holds, ask for nothing.
std::string policy(const std::vector<std::string_view>& scripts) {
  std::string digests;
  for (const std::string_view script : scripts) {
    digests += " " + policy_digest(script);
  }
  return "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri 'none'; "
         "form-action 'none'; img-src data:; style-src 'unsafe-inline'; script-src" +
         digests + "\">\n";
}

std::string script_elements(const std::vector<std::string_view>& scripts) {
  std::string html;
  for (const std::string_view script : scripts) {
    html += "<script type=\"module\">" + std::string(script) + "</script>\n";
  }
  return html;
}

}  // namespace

std::string element(const std::string& name, const std::string& content, const std::string& attributes) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + name + ">\n";
}

std::string html_page(const std::string& title, const std::string& lead,
                      const std::vector<PageSection>& sections,
                      const std::vector<std::string_view>& scripts) {
  std::string links, content;
  for (const PageSection& section : sections) {
    if (!section.html.empty()) {
      const std::string id = markup_text(section.id), name = markup_text(section.name);
      links += "<a href=\"#" + id + "\">" + name + "</a>";
      content += element("section", element("h2", name) + section.html, "id=\"" + id + "\"");
    }
  }
  std::vector<std::string_view> all{sort_tables_script(), live_plots_script()};
  all.insert(all.end(), scripts.begin(), scripts.end());
  const std::string text = markup_text(title);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" + policy(all) +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" + text +
         "</title>\n<style>" + kStyle + "</style></head>\n<body>\n" + element("h1", text) + lead +
         element("nav", links) + content + script_elements(all) + "</body></html>\n";
}

}  // namespace cbc3d::reports
