#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_limit.hpp>

namespace boresight::app {
namespace {

using Row = std::vector<std::string>;

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string mdeg(double angle) {
  return fixed(angle / millidegree, 4);
}

std::string ratio(const std::optional<double>& value) {
  return value ? fixed(*value, 3) : "-";
}

Row cells(const std::string& name, const design::SampledDesign& design) {
  const design::SampledResult& nominal = design.nominal;
  const bool members = !design.members.empty();
  return {name,
          mdeg(nominal.boresight_rms),
          mdeg(nominal.wind_rms),
          mdeg(nominal.noise_rms),
          fixed(nominal.control_effort, 3),
          fixed(nominal.peak.magnitude, 3),
          members ? mdeg(design.worst_rms) : "-",
          members ? fmt::format("{}/{}", design.stable_members, design.members.size()) : "-"};
}

}  // namespace

Document document_of(const design::PointingLimit& limit) {
  Document text = heading("Distance from the best possible controller");
  text += wrapped(
      fmt::format("Controllers sampled every {:g} s, zero-order hold, {:g} s of computation delay; "
                  "closed-loop covariance, wind by its shaping filter. The tuning limits the "
                  "control effort of continuous loops: sampled ones may exceed it.",
                  limit.sample_time, limit.computation_delay),
      "  ");
  std::vector<Row> rows{{"controller", "rms mdeg", "wind", "noise", "effort rad/s", "S valve",
                         "worst plant", "stable plants"}};
  rows.push_back(cells("LQG, unconstrained", limit.unconstrained));
  if (limit.margin_limited) {
    rows.push_back(
        cells(fmt::format("LQG, S valve <= {:g}", limit.peak_limit), limit.margin_limited->design));
  }
  if (limit.robustified) {
    rows.push_back(cells("LQG, robust over the plants", limit.robustified->design));
  }
  if (limit.refined) rows.push_back(cells("state space, refined", *limit.refined));
  for (const auto& controller : limit.controllers) {
    rows.push_back(controller.design.nominal.stable() ? cells(controller.name, controller.design)
                                                      : Row{controller.name, "unstable"});
  }
  for (Row& row : rows) row.resize(rows.front().size(), "-");
  text += essential(table(rows, "l"));
  text += wrapped(fmt::format("Lower bound: {} mdeg, of any linear controller with the same "
                              "sensors, sampling and delay and a control effort of at most {:g} "
                              "rad/s. The unconstrained LQG reaches it; the others are benchmarks.",
                              mdeg(limit.min_rms), limit.effort_limit),
                  "  ");
  text += wrapped(fmt::format("Structural flexure beyond the encoder alone: {} mdeg. Full state "
                              "known exactly at each sample, effort free: {} mdeg.",
                              mdeg(limit.flexure_rms), mdeg(limit.full_information_rms)),
                  "  ");
  if (!limit.margin_limited) {
    text +=
        wrapped("No LQG of the searched weights meets the Ms limit on the nominal plant.", "  ");
  }
  if (!limit.robustified && !limit.unconstrained.members.empty()) {
    text += wrapped("No LQG of the searched weights meets the constraints on every plant.", "  ");
  }
  if (!limit.refined && !limit.unconstrained.members.empty()) {
    text += wrapped(
        "No refined state-space controller: there is no start, the start has repeated poles, or "
        "the search found none that meets every constraint.",
        "  ");
  }
  if (limit.controllers.empty()) return text;
  std::vector<Row> ratios{{"rms of controller over", "bound at its effort", "LQG with margins",
                           "robust LQG", "worst: robust LQG", "flexure alone"}};
  for (const auto& controller : limit.controllers) {
    ratios.push_back({controller.name, ratio(controller.to_min),
                      ratio(controller.to_margin_limited), ratio(controller.to_robustified),
                      ratio(controller.worst_to_robustified), ratio(controller.to_flexure)});
  }
  return text + "\n" + table(ratios, "l");
}

}  // namespace boresight::app
