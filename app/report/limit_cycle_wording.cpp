#include <fmt/format.h>

#include <boresight/app/report/limit_cycle_wording.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {

std::string limit_cycle_cell(const design::LimitCycleResult& limit_cycles) {
  if (limit_cycles.status != design::RunStatus::complete) {
    return std::string(design::to_string(limit_cycles.status));
  }
  if (!limit_cycles.limit_cycle) return "none";
  std::string cell = fmt::format("+-{:.4f}", limit_cycles.boresight_amplitude / millidegree);
  if (limit_cycles.some_only()) {
    cell += fmt::format(" ({}/{})", limit_cycles.starts_with_limit_cycle, limit_cycles.starts);
  }
  return cell;
}

std::string limit_cycle_legend() {
  return fmt::format(
      "limit cycle: largest boresight amplitude (mdeg) of {0} runs without wind or noise, from "
      "different initial steps; (n/{0}): in n of them only",
      design::limit_cycle_starts);
}

}  // namespace boresight::app
