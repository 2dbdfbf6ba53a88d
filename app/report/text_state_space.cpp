#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/report/limit_cycle_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_state_space.hpp>

namespace boresight::app {
namespace {

using Row = std::vector<std::string>;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string amplitude(const design::NonlinearVerification& run, bool at_rest) {
  for (const auto& limit_cycles : run.limit_cycles) {
    if ((limit_cycles.rate == 0.0) == at_rest) return limit_cycle_cell(limit_cycles);
  }
  return "-";
}

std::string settling(const std::optional<design::SlewResult>& slew) {
  if (!slew) return "-";
  return slew->settling_time ? fmt::format("{:.2f}", *slew->settling_time) : "not seen";
}

std::string percent(double fraction) {
  return fmt::format("{:.0f} %", 100.0 * std::abs(fraction));
}

}  // namespace

Document document_of(const design::StateSpaceStudy& study, const TimeDomainSection& loops) {
  const design::SimulatedCandidate own = loops.own();
  std::vector<Row> rows{{"mdeg at the sky", own.controller, study.simulated.controller}};
  const auto add = [&](const std::string& what, const auto& of) {
    rows.push_back({what, of(own), of(study.simulated)});
  };
  add("rms, linear",
      [](const design::SimulatedCandidate& one) { return mdeg(one.result.wind.predicted_rms); });
  add("rms, simulated",
      [](const design::SimulatedCandidate& one) { return mdeg(one.simulated_rms()); });
  add("limit cycle at rest",
      [](const design::SimulatedCandidate& one) { return amplitude(one.result, true); });
  add("limit cycle when tracking",
      [](const design::SimulatedCandidate& one) { return amplitude(one.result, false); });
  add("peak error at a velocity reversal, encoder", [](const design::SimulatedCandidate& one) {
    return one.result.reversal ? mdeg(one.result.reversal->encoder_error) : "-";
  });
  add("static boresight error in the mean wind",
      [](const design::SimulatedCandidate& one) { return mdeg(one.result.wind.static_error); });
  add("slew overshoot", [](const design::SimulatedCandidate& one) {
    return one.result.slew ? mdeg(one.result.slew->overshoot) : "-";
  });
  add("slew settled after, s",
      [](const design::SimulatedCandidate& one) { return settling(one.result.slew); });
  Document text = heading("A state-space controller instead of loops");
  text += wrapped(
      fmt::format("The LQG of the table above that is robust over the plants, reduced to the "
                  "lowest order that meets the same constraints, and the recommended loops in the "
                  "same runs on the nonlinear antenna, wind of {:.3g} m/s.",
                  study.wind_speed),
      "  ");
  text += essential(table(rows, "l"));
  text += wrapped(
      "It also meets Ms at standstill and is stable by itself. It is not among the controllers to "
      "recommend: it has no loops to close one by one, no constraint on the rate loop alone or on "
      "the position loop, and no anti-windup. --mat writes it as state_space_controller, which "
      "`boresight benchmark CASE --controller FILE --part state_space_controller` evaluates.",
      "  ");
  return text;
}

std::string state_space_advantage(const design::StateSpaceStudy& study) {
  if (!study.limit_cycle_free || !study.change || !(study.change->upper < 0.0)) return "";
  return fmt::format(
      "A state-space controller of the same sensors ({}) has {:.3f} mdeg rms simulated, {} less "
      "(95 % {} to {}), and no limit cycle beyond the tightest budget; it cannot be commissioned "
      "loop by loop.",
      study.simulated.controller, study.simulated.simulated_rms() / millidegree,
      percent(study.change->value), percent(study.change->upper), percent(study.change->lower));
}

}  // namespace boresight::app
