#include "fault_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace boresight::faults {
namespace {

std::string shown(std::size_t count) {
  return count > 0 ? std::to_string(count) : "";
}

std::string row_text(const std::string& kind, const std::string& fault, const FaultRow& row) {
  std::string text = fmt::format("| {} | {} |", kind, fault);
  for (const std::size_t count : row.count) text += " " + shown(count) + " |";
  return text +
         (row.largest_error > 0.0 ? fmt::format(" {:.1f} % |", 100.0 * row.largest_error)
                                  : std::string(" |")) +
         "\n";
}

std::string quoted(std::string text) {
  std::ranges::replace(text, '"', '\'');
  std::ranges::replace(text, '\n', ' ');
  return '"' + text + '"';
}

}  // namespace

std::vector<FaultRow> fault_rows(const std::vector<FaultCase>& cases) {
  std::vector<FaultRow> rows;
  for (const FaultCase& one : cases) {
    if (rows.empty() || rows.back().fault != one.fault) {
      rows.push_back({one.kind, one.fault, {}, 0, 0.0});
    }
    FaultRow& row = rows.back();
    ++row.count[static_cast<std::size_t>(one.outcome)];
    ++row.campaigns;
    if (one.rejection.empty()) row.largest_error = std::max(row.largest_error, std::abs(one.error));
  }
  return rows;
}

std::string fault_markdown(const std::vector<FaultCase>& cases) {
  std::string text = "| kind | fault |";
  std::string line = "|---|---|";
  for (std::size_t i = 0; i < outcomes; ++i) {
    text += fmt::format(" {} |", to_string(static_cast<Outcome>(i)));
    line += "---|";
  }
  text += " largest error |\n" + line + "---|\n";
  FaultRow all;
  for (const FaultRow& row : fault_rows(cases)) {
    text += row_text(row.kind, row.fault, row);
    for (std::size_t i = 0; i < outcomes; ++i) all.count[i] += row.count[i];
    all.largest_error = std::max(all.largest_error, row.largest_error);
  }
  return text + row_text("*all*", "", all);
}

std::string fault_details(const std::vector<FaultCase>& cases) {
  std::string text =
      "kind,fault,campaign,outcome,named,error,relative_half_width,visible_error,conflict,"
      "departure,rejection,findings\n";
  for (const FaultCase& one : cases) {
    const double half =
        one.inertia ? 0.5 * (one.inertia->upper - one.inertia->lower) / std::abs(one.inertia->value)
                    : 0.0;
    fmt::format_to(
        std::back_inserter(text), "{},{},{},{},{},{:.4g},{:.4g},{:.3g},{:.3g},{:.3g},{},{}\n",
        one.kind, quoted(one.fault), one.campaign, to_string(one.outcome), one.named ? 1 : 0,
        one.error, half, one.check ? one.check->visible_error : 0.0, one.conflict, one.departure,
        quoted(one.rejection), quoted(fmt::format("{}", fmt::join(one.findings, " | "))));
  }
  return text;
}

}  // namespace boresight::faults
