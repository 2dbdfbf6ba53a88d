
#include <boresight/app/models/linear_models.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/io/exchange/state_space_formats.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::app {
namespace {

// Hz and points a decade of the responses written.
constexpr double lowest_frequency = 1e-3, highest_frequency = 25.0;
constexpr int points_per_decade = 100;

io::MatVariables parameters(const LinearModels& models) {
  const auto& drive = models.antenna.drive;
  const auto& structure = models.antenna.structure;
  io::MatVariables fields;
  fields.add_number("gear_ratio_1", models.gear_ratio);
  if (models.loop) fields.add_number("dead_time_s", models.loop->dead_time);
  fields.add_number("oil_stiffness_N_m_per_rad", drive.oil_stiffness);
  fields.add_number("leakage_rate_per_s", drive.leakage_rate);
  fields.add_number("viscous_friction_N_m_s_per_rad", drive.viscous_friction);
  fields.add_number("motor_side_inertia_kg_m2", drive.motor_inertia);
  fields.add_number("antenna_inertia_kg_m2", plant::antenna_inertia(structure));
  fields.add_number("reflected_inertia_kg_m2", plant::reflected_inertia(models.antenna));
  fields.add_number("valve_frequency_Hz", drive.valve_corner / two_pi);
  fields.add_number("valve_damping_ratio_1", drive.valve_damping);
  fields.add_number("tachometer_corner_rad_per_s", drive.tachometer_corner);
  fields.add_number("bull_gear_inertia_kg_m2", structure.bull_gear_inertia);
  fields.add_number("gear_stiffness_N_m_per_rad", structure.gear_stiffness);
  fields.add_number("gear_damping_N_m_s_per_rad", structure.gear_damping);
  fields.add_number("bull_gear_wind_fraction_1", structure.bull_gear_wind_fraction);
  fields.add_number("bull_gear_beam_weight_1", structure.bull_gear_beam_weight);
  const auto count = static_cast<Eigen::Index>(structure.modes.size());
  Eigen::MatrixXd modes(count, 5);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& mode = structure.modes[static_cast<std::size_t>(i)];
    modes.row(i) << mode.inertia, mode.stiffness, mode.damping, mode.wind_fraction,
        mode.beam_weight;
  }
  fields.add_matrix("mode_inertia_kg_m2", modes.col(0));
  fields.add_matrix("mode_stiffness_N_m_per_rad", modes.col(1));
  fields.add_matrix("mode_damping_N_m_s_per_rad", modes.col(2));
  fields.add_matrix("mode_wind_fraction_1", modes.col(3));
  fields.add_matrix("mode_beam_weight_1", modes.col(4));
  return fields;
}

// Fields frequency_Hz and response, outputs x inputs x frequencies, beside the names.
io::MatVariables response_fields(const Eigen::ArrayXd& frequency,
                                 const std::vector<Eigen::MatrixXcd>& pages,
                                 const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& outputs) {
  io::MatVariables fields;
  fields.add_matrix("frequency_Hz", (frequency / two_pi).matrix());
  fields.add_pages("response", pages);
  fields.add_texts("inputs", inputs);
  fields.add_texts("input_units", io::signal_units(inputs));
  fields.add_texts("outputs", outputs);
  fields.add_texts("output_units", io::signal_units(outputs));
  return fields;
}

io::MatVariables plant_response_fields(const LinearModels& models,
                                       const Eigen::ArrayXd& frequency) {
  const auto response = plant::plant_response(models.antenna, frequency);
  std::vector<Eigen::MatrixXcd> pages;
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const auto at = plant::point(response, i);
    Eigen::MatrixXcd page(4, 2);
    page << at.tachometer_command, at.tachometer_wind, at.torque_command, at.torque_wind,
        at.encoder_command, at.encoder_wind, at.boresight_command, at.boresight_wind;
    pages.push_back(std::move(page));
  }
  return response_fields(frequency, pages, models.plant.inputs, models.plant.outputs);
}

io::MatVariables closed_loop_response_fields(const ControllerModels& loop,
                                             const Eigen::ArrayXd& frequency) {
  std::vector<Eigen::MatrixXcd> pages;
  for (const double w : frequency) {
    pages.push_back(plant::frequency_response(loop.closed_loop, w));
  }
  return response_fields(frequency, pages, loop.closed_loop.inputs, loop.closed_loop.outputs);
}

// L at each break with its exact dead time: S = 1/(1 + L).
io::MatVariables loop_gain_fields(const LinearModels& models, const ControllerModels& loop,
                                  const Eigen::ArrayXd& frequency) {
  const plant::PointResponse response(models.antenna);
  io::MatVariables fields;
  fields.add_matrix("frequency_Hz", (frequency / two_pi).matrix());
  constexpr std::array names{"rate_loop_alone", "valve_command", "position_loop"};
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    std::vector<Eigen::MatrixXcd> pages;
    for (const double w : frequency) {
      pages.emplace_back(
          Eigen::MatrixXcd::Constant(1, 1,
                                     control::loop_gain(response(w), w, loop.controller,
                                                        loop.dead_time, control::loop_breaks[b])));
    }
    fields.add_pages(names[b], pages);
  }
  return fields;
}

io::MatVariables gain_fields(const control::Controller& controller) {
  const auto& descriptions = controller.structure.gains();
  io::MatVariables fields;
  std::vector<std::string> symbols, names, units;
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    fields.add_number(descriptions[i].symbol, controller.gains[i]);
    symbols.push_back(descriptions[i].symbol);
    names.push_back(descriptions[i].name);
    units.push_back(descriptions[i].unit);
  }
  fields.add_texts("symbols", symbols);
  fields.add_texts("names", names);
  fields.add_texts("units", units);
  return fields;
}

}  // namespace

std::string to_mat(const LinearModels& models, const std::string& command,
                   const std::string& case_path) {
  const Eigen::ArrayXd frequency =
      plant::frequency_grid(models.antenna, lowest_frequency, highest_frequency, points_per_decade);
  io::MatVariables variables;
  variables.add_text("program", "boresight " BORESIGHT_VERSION);
  variables.add_text("command", command);
  variables.add_text("case_path", case_path);
  variables.add_structure("parameters", parameters(models));
  variables.add_structure("plant", io::state_space_mat(models.plant));
  variables.add_structure("plant_response", plant_response_fields(models, frequency));
  if (models.loop) {
    const ControllerModels& loop = *models.loop;
    variables.add_text("controller_name", loop.description);
    variables.add_text("structure", loop.controller.structure.name());
    variables.add_structure("gains", gain_fields(loop.controller));
    variables.add_structure("controller", io::state_space_mat(loop.continuous));
    variables.add_structure("sampled_controller", io::state_space_mat(loop.sampled_controller));
    variables.add_structure("closed_loop", io::state_space_mat(loop.closed_loop));
    variables.add_structure("closed_loop_response", closed_loop_response_fields(loop, frequency));
    variables.add_structure("loop_gain", loop_gain_fields(models, loop, frequency));
  }
  if (models.state_space_controller) {
    variables.add_structure("state_space_controller",
                            io::state_space_mat(*models.state_space_controller));
  }
  return variables.file("linear models of an antenna by boresight");
}

}  // namespace boresight::app
