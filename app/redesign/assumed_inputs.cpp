#include <algorithm>
#include <array>
#include <string_view>

#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_simulation.hpp>

namespace boresight::app {
namespace {

using namespace std::string_view_literals;

constexpr std::array steady_keys{
    "return_pressure"sv, "null_leakage_share"sv, "case_leakage_share"sv,
    "valve_stroke"sv,    "valve_overlap"sv,      "makeup_pressure"sv,
    "offset_torque"sv,   "offset_cosine"sv,      "offset_sine"sv};
// What identification takes of [recorder] where there are no [instruments].
constexpr std::array instrument_keys{"pressure_gain"sv, "pressure_zero"sv, "tachometer_gain"sv};

bool rests_on_simulation(const io::Case& antenna, std::string_view name,
                         const NonlinearInputs& uses) {
  const bool records = !antenna.campaign->records.empty() && !antenna.campaign->return_pressure;
  if (name == "return_pressure" && records) return true;
  if (name == "valve_stroke" && (uses.valve_stroke || antenna.goals->crest_factor)) return true;
  if (name.starts_with("rate_loop_")) return uses.rate_loop;
  if (std::ranges::find(steady_keys, name) != steady_keys.end()) {
    return uses.steady_motion || uses.time_runs;
  }
  const bool loose_gears = antenna.simulation && antenna.simulation->backlash;
  return uses.time_runs && (name != "preload_torque" || loose_gears);
}

bool rests_on_recorder(const io::Case& antenna, std::string_view name,
                       const NonlinearInputs& uses) {
  const bool records = !antenna.campaign->records.empty() && !antenna.campaign->instruments;
  return uses.recorder ||
         (records && std::ranges::find(instrument_keys, name) != instrument_keys.end());
}

bool rests_on(const io::Case& antenna, std::string_view key, const NonlinearInputs& uses) {
  constexpr auto simulation = "simulation."sv, recorder = "recorder."sv;
  if (key.starts_with(simulation)) {
    return rests_on_simulation(antenna, key.substr(simulation.size()), uses);
  }
  if (key.starts_with(recorder)) {
    return rests_on_recorder(antenna, key.substr(recorder.size()), uses);
  }
  return uses.computer || !key.starts_with("computer."sv);
}

}  // namespace

std::vector<io::Quantity> assumed_inputs(const io::Case& antenna,
                                         const NonlinearInputs& nonlinear) {
  std::vector<io::Quantity> assumed;
  for (const auto& quantity : antenna.quantities) {
    const bool guessed =
        quantity.basis == io::Basis::assumed || quantity.uncertainty_source.starts_with("assumed");
    if (guessed && rests_on(antenna, quantity.key, nonlinear)) assumed.push_back(quantity);
  }
  return assumed;
}

std::vector<io::Quantity> identification_inputs(const io::Case& antenna) {
  constexpr std::array parts{"antenna.inertia"sv,
                             "antenna.alternative"sv,
                             "gear_train."sv,
                             "motor."sv,
                             "oil."sv,
                             "tachometer."sv,
                             "instruments."sv,
                             "recorder."sv,
                             "resonance."sv,
                             "impulse"sv,
                             "friction_tests."sv,
                             "structure.prediction"sv,
                             "structure.locked_rotor_frequency"sv,
                             "drive.supply_pressure"sv,
                             "drive.return_pressure"sv,
                             "drive.tracking_rate"sv,
                             "simulation.return_pressure"sv};
  std::vector<io::Quantity> inputs = assumed_inputs(antenna);
  std::erase_if(inputs, [&](const io::Quantity& quantity) {
    return std::ranges::none_of(
        parts, [&](std::string_view part) { return quantity.key.starts_with(part); });
  });
  return inputs;
}

std::size_t count_of_antenna(const std::vector<io::Quantity>& assumed) {
  return static_cast<std::size_t>(std::ranges::count_if(assumed, [](const io::Quantity& quantity) {
    return !quantity.key.starts_with("goals.") && !quantity.key.starts_with("pointing.");
  }));
}

}  // namespace boresight::app
