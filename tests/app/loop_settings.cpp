// Random settings of report-page sliders with what the program makes of each, as JSON:
//
//   loop_settings COUNT
//
// loop_analysis_test.mjs holds the page's own numbers against these.
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "design/reference_problem.hpp"
#include <boresight/app/report/json_writer.hpp>
#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/studies/adjustable_loop.hpp>
#include <boresight/io/description/adjustable_loop_description.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::app {
namespace {

using nlohmann::json;

// Steps of the responses, s.
constexpr double step = 0.25;
constexpr Eigen::Index steps = 160;

design::AdjustableLoop loop_of(control::Controller controller, double disks,
                               plant::WindModel model) {
  design::TrackingProblem problem = reference::tracking_problem(disks);
  problem.wind.model = model;
  const std::string name = controller.structure.name();
  return {name, std::move(controller), std::move(problem), {}};
}

// Every kind of block, wind model and gust spectrum.
std::vector<design::AdjustableLoop> loops() {
  control::Controller all{control::LoopStructure::named("FULL+N+C"), {}};
  const std::map<std::string, double> gains{
      {"kr", 0.2}, {"wi", 0.8}, {"wz", 30.0}, {"wp", 6.0},   {"wn", 15.0}, {"zz", 0.3}, {"zp", 0.7},
      {"kT", 0.1}, {"wd", 3.0}, {"kp", 0.2},  {"wip", 0.02}, {"cs", 5e-3}, {"wcs", 3.0}};
  for (const auto& gain : all.structure.gains()) all.gains.push_back(gains.at(gain.symbol));
  const auto cautious = reference::cautious_gains();
  std::vector<design::AdjustableLoop> list{loop_of(cautious, 24.0, plant::WindModel::coherence),
                                           loop_of(cautious, 0.0, plant::WindModel::vickery),
                                           loop_of(all, 24.0, plant::WindModel::coherence),
                                           loop_of(all, 12.0, plant::WindModel::uniform)};
  list[1].problem.wind.site.gusts = plant::kaimal_gusts(0.15, 40.0);
  list[2].problem.wind.site.gusts = plant::von_karman_gusts(0.15, 120.0);
  list[2].problem.noise.torque_rms = 2.0;
  list[3].problem.wind.site.gusts = plant::eurocode_gusts(40.0, 0.05, 2.0);
  list[3].problem.rms_band = {1e-3, 10.0};
  return list;
}

json row_of(const Eigen::MatrixXd& column) {
  return std::vector<double>(column.data(), column.data() + column.size());
}

// From the rate command, which enters as the negative of the tachometer's noise, to the tachometer.
plant::StateSpace rate_loop(const design::TrackingProblem& problem,
                            const control::Controller& controller) {
  plant::StateSpace state_space = control::rate_loop_controller(controller);
  state_space.inputs[0] = "rate_error_measured";
  const plant::StateSpace sum =
      plant::static_gain((Eigen::MatrixXd(1, 2) << 1.0, -1.0).finished(),
                         {"tachometer", "rate_command"}, {"rate_error_measured"});
  return plant::connect({plant::subsystem(plant::to_state_space(problem.plant), {"valve_command"},
                                          {"tachometer", "motor_torque"}),
                         sum, state_space,
                         control::delay_approximant(problem.delay, control::delay_order,
                                                    "valve_demand", "valve_command")},
                        {"rate_command"}, {"tachometer"});
}

json step_response(const plant::StateSpace& loop) {
  plant::LinearSimulation simulation(loop, step);
  return row_of(simulation.simulate(Eigen::MatrixXd::Ones(steps, 1)));
}

json margins_json(const control::Margins& margins) {
  return {{"gain_up", margins.increasing_gain_margin},
          {"gain_down", margins.decreasing_gain_margin},
          {"phase_deg", margins.phase_margin_deg},
          {"delay", margins.delay_margin},
          {"peak", margins.sensitivity.magnitude},
          {"peak_frequency", margins.sensitivity.frequency}};
}

json expected(const design::AdjustableLoop& loop) {
  const design::Design design = design::assess(loop.problem, loop.controller, loop.goals);
  json result{{"stable", design.tuning.status != design::TuningStatus::unstable}};
  if (!result["stable"]) return result;
  const auto& stability = design.verification.stability;
  result["beam"] = design.boresight_rms;
  result["wind"] = design.wind_rms;
  result["noise"] = design.noise_rms;
  result["effort"] = design.control_effort;
  result["rate_loop_abscissa"] = stability.rate_loop_abscissa;
  result["closed_loop_abscissa"] = stability.closed_loop_abscissa;
  for (const auto& margins : design.margins) result["margins"].push_back(margins_json(margins));
  result["position_step"] =
      step_response(reference::command_to_encoder(loop.problem, loop.controller));
  result["rate_step"] = step_response(rate_loop(loop.problem, loop.controller));
  return result;
}

// The loop with gains, drive and wind moved by random factors.
json setting(design::AdjustableLoop loop, std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  const auto factor = [&](double largest) { return std::exp(largest * exponent(random)); };
  for (double& gain : loop.controller.gains) gain *= factor(1.3);
  auto& drive = loop.problem.plant.drive;
  drive.oil_stiffness *= factor(0.7);
  drive.leakage_rate *= factor(1.0);
  drive.viscous_friction *= factor(1.0);
  loop.problem.wind.mean_speed *= factor(0.7);
  return {{"gains", loop.controller.gains},
          {"setting",
           {{"oil_stiffness", drive.oil_stiffness},
            {"leakage_rate", drive.leakage_rate},
            {"viscous_friction", drive.viscous_friction},
            {"wind_speed", loop.problem.wind.mean_speed}}},
          {"expected", expected(loop)}};
}

}  // namespace
}  // namespace boresight::app

int main(int count, char** words) {
  using namespace boresight::app;
  if (count != 2) return 2;
  const int settings = std::atoi(words[1]);
  const auto starting = loops();
  std::mt19937_64 random(1);
  nlohmann::json result{{"step", step}, {"loops", nlohmann::json::array()}};
  for (const auto& one : starting) {
    result["loops"].push_back({{"data", json_of(one)}, {"settings", nlohmann::json::array()}});
  }
  for (int i = 0; i < settings; ++i) {
    const auto k = static_cast<std::size_t>(i) % starting.size();
    result["loops"][k]["settings"].push_back(setting(starting[k], random));
  }
  fmt::print("{}\n", result.dump());
}
