#include <fmt/format.h>

#include <boresight/app/change/change_report.hpp>
#include <boresight/app/document/document_html.hpp>
#include <boresight/app/report/axis_wording.hpp>

namespace boresight::app {
namespace {

// Fits one sheet of A4 or letter paper.
constexpr const char* style =
    "@page{margin:12mm}@media print{body{margin:0!important}}"
    "#controllers{columns:2}#controllers h2{column-span:all}#controllers h3{break-after:avoid}"
    "#controllers .table{break-inside:avoid}body{font:9pt/1.3 "
    "sans-serif;max-width:182mm;margin:8mm auto;color:#111}"
    "h1{font-size:14pt;margin:0}h2{font-size:11pt;margin:3mm 0 1mm;border-bottom:.3mm solid #888}"
    "h3{font-size:9.5pt;margin:1.5mm 0 .5mm}p{margin:.8mm 0}table{border-collapse:collapse}"
    "th,td{padding:.4mm 2.5mm .4mm 0;text-align:left;font-weight:normal;vertical-align:top}"
    "thead th{border-bottom:.2mm solid #888}.right{text-align:right}"
    ".decision{font-weight:bold;border:.3mm solid #111;padding:1.5mm 2.5mm}"
    ".signatures td{border-bottom:.2mm solid #111;height:9mm;width:45mm;vertical-align:bottom}";

}  // namespace

std::string change_record(const ChangeReport& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"/>\n"
      "<title>Change record: {0}</title>\n<style>{1}</style></head>\n<body>\n"
      "<h1>Change record: {0}</h1>\n<p>{2}{3}</p>\n",
      escaped_html(report.title), style, escaped_html(report.case_path),
      escaped_html(report.axis.name.empty() ? "" : ", " + words_of(report.axis)));
  html += "<div class=\"decision\">";
  for (const auto& sentence : decision(report)) {
    html += fmt::format("<p>{}</p>", escaped_html(sentence));
  }
  html += "</div>\n";
  html += to_html(controllers_part(report) + evidence_part(report) + checks_part(report));
  html += "<section><h2>Signatures</h2>\n<table class=\"signatures\">";
  for (const char* role : {"changed by", "checked by", "approved by"}) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>initials</td><td>date</td></tr>\n", role);
  }
  return html + "</table></section>\n</body>\n</html>\n";
}

}  // namespace boresight::app
