#include <cmath>
#include <utility>

#include <boresight/app/report/report.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

Report begin_report(std::string command, const io::Case& antenna, std::string case_path,
                    std::uint64_t seed) {
  Report report;
  report.command = std::move(command);
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.case_path = std::move(case_path);
  report.seed = seed;
  return report;
}

std::optional<double> InterpretationResult::missed_resonance() const {
  if (!wanted_frequency || !design) return std::nullopt;
  constexpr double same = 0.05;
  return std::abs(resonance / *wanted_frequency - 1.0) < same ? std::nullopt
                                                              : std::optional(resonance);
}

void lead_with_resonance(Report& report) {
  std::string warning = resonance_warning(report.resonance);
  if (!warning.empty()) report.conclusions.insert(report.conclusions.begin(), std::move(warning));
}

}  // namespace boresight::app
