#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/guessed_shares_held.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

// Boresight rms (rad); NaN where the loop is unstable.
double held_rms(const io::Case& antenna, const control::ControlLaw& law, double wind_speed,
                io::GuessedShares place) {
  design::TrackingProblem problem =
      make_problem(antenna, guessed_share_changes(*antenna.structure, place));
  problem.wind.mean_speed = wind_speed;
  return design::judge(problem, {{"the case's", problem.plant}}, law, {}, 1)
      .members.front()
      .beam_rms;
}

}  // namespace

void conclude_guessed_shares(const io::Case& antenna, const control::ControlLaw& law,
                             double wind_speed, std::vector<std::string>& sentences) {
  const double own = held_rms(antenna, law, wind_speed, io::GuessedShares::as_stated);
  // The fractions are outside the loop and do not affect stability.
  if (!std::isfinite(own)) return;
  std::vector<std::string> others;
  bool apart = false;
  for (const auto place : io::other_guesses) {
    if (!moves_guessed_shares(*antenna.structure, place)) continue;
    const double rms = held_rms(antenna, law, wind_speed, place);
    apart = apart || std::abs(rms / own - 1.0) > telling_change;
    others.push_back(fmt::format("{:.3f} mdeg with {}", rms / millidegree, to_string(place)));
  }
  if (!apart) return;
  sentences.push_back(
      fmt::format("The modal participation of wind torque and boresight is assumed, and not in the "
                  "uncertainty set. With fixed gains, the linear {:.3f} mdeg of {} on the case's "
                  "plant would be {}. Rankings may change with it.",
                  own / millidegree, law.structure.name(), fmt::join(others, ", ")));
}

}  // namespace boresight::app
