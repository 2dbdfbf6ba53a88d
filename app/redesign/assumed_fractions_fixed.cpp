#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/assumed_fractions_fixed.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

// Boresight rms (rad); NaN where the loop is unstable.
double held_rms(const io::Case& antenna, const control::Controller& controller, double wind_speed,
                io::GuessedFractions place) {
  design::TrackingProblem problem =
      make_problem(antenna, guessed_fraction_changes(*antenna.structure, place));
  problem.wind.mean_speed = wind_speed;
  return design::evaluate(problem, {{"the case's", problem.plant}}, controller, {}, 1)
      .members.front()
      .boresight_rms;
}

}  // namespace

void conclude_guessed_fractions(const io::Case& antenna, const control::Controller& controller,
                                double wind_speed, std::vector<std::string>& sentences) {
  const double own = held_rms(antenna, controller, wind_speed, io::GuessedFractions::as_stated);
  // The fractions are outside the loop and do not affect stability.
  if (!std::isfinite(own)) return;
  std::vector<std::string> others;
  bool apart = false;
  for (const auto place : io::other_guesses) {
    if (!moves_guessed_fractions(*antenna.structure, place)) continue;
    const double rms = held_rms(antenna, controller, wind_speed, place);
    apart = apart || std::abs(rms / own - 1.0) > telling_change;
    others.push_back(fmt::format("{:.3f} mdeg with {}", rms / millidegree, to_string(place)));
  }
  if (!apart) return;
  sentences.push_back(
      fmt::format("The modal participation of wind torque and boresight is assumed, and not in the "
                  "uncertainty set. With fixed gains, the linear {:.3f} mdeg of {} on the case's "
                  "plant would be {}. Rankings may change with it.",
                  own / millidegree, controller.structure.name(), fmt::join(others, ", ")));
}

}  // namespace boresight::app
