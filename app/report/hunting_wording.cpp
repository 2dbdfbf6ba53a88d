#include <fmt/format.h>

#include <boresight/app/report/hunting_wording.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {

std::string hunting_cell(const design::HuntingResult& hunting) {
  if (hunting.status != design::RunStatus::complete) {
    return std::string(design::to_string(hunting.status));
  }
  if (!hunting.limit_cycle) return "none";
  std::string cell = fmt::format("+-{:.4f}", hunting.beam_amplitude / millidegree);
  if (hunting.some_only()) {
    cell += fmt::format(" ({}/{})", hunting.starts_hunting, hunting.starts);
  }
  return cell;
}

std::string hunting_legend() {
  return fmt::format(
      "limit cycle: largest boresight amplitude (mdeg) of {0} runs without wind or noise, from "
      "different initial steps; (n/{0}): in n of them only",
      design::hunting_starts);
}

}  // namespace boresight::app
