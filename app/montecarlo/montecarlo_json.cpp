#include <fmt/format.h>

#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/json_assumed.hpp>
#include <boresight/app/report/json_design.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using design::DistributionSummary;
using design::EstimatedNumber;

Json estimated(const EstimatedNumber& estimate, double unit = 1.0) {
  return {{"value", number(estimate.value / unit)},
          {"lower", number(estimate.lower / unit)},
          {"upper", number(estimate.upper / unit)}};
}

Json distribution_json(const DistributionSummary& summary, double unit = 1.0) {
  Json quantiles = Json::array();
  for (const auto& [share, value] : summary.quantiles) {
    Json row{{"share_1", share}};
    row.update(estimated(value, unit));
    quantiles.push_back(std::move(row));
  }
  return {{"plants", summary.draws},
          {"mean", estimated(summary.mean, unit)},
          {"standard_deviation", estimated(summary.standard_deviation, unit)},
          {"least", number(summary.least / unit)},
          {"largest", number(summary.largest / unit)},
          {"quantiles", std::move(quantiles)}};
}

Json optional_json(const std::optional<DistributionSummary>& summary, double unit = 1.0) {
  return summary ? distribution_json(*summary, unit) : Json(nullptr);
}

Json draw_json(const PlantDraw& draw) {
  using enum UncertainInput;
  return {{"structure_frequency_1", draw[structure_frequency]},
          {"oil_stiffness_1", draw[oil_stiffness]},
          {"leakage_rate_1", draw[leakage_rate]},
          {"friction_slope_N_m_s_per_rad", draw[friction_slope]},
          {"antenna_inertia_1", draw[antenna_inertia]},
          {"motor_inertia_1", draw[motor_inertia]},
          {"wind_torque_1", draw[wind_torque]}};
}

std::string_view standing_text(design::Standing standing) {
  switch (standing) {
    case design::Standing::unstable:
      return "unstable";
    case design::Standing::undecided:
      return "undecided";
    case design::Standing::stable_by_eigenvalues:
    case design::Standing::stable_by_winding:
      break;
  }
  return "stable";
}

Json plant_json(const NotablePlant& plant) {
  const auto& outcome = plant.outcome;
  Json peaks = Json::array();
  for (const double peak : outcome.sensitivity_peaks) peaks.push_back(number(peak));
  return {{"index", plant.index},
          {"inputs", draw_json(plant.draw)},
          {"standing", standing_text(outcome.standing)},
          {"beam_rms_mdeg", number(outcome.beam_rms / millidegree)},
          {"climate_beam_rms_mdeg", number(outcome.climate_rms / millidegree)},
          {"valve_effort_rad_per_s", number(outcome.valve_effort)},
          {"sensitivity_peaks_1", std::move(peaks)},
          {"worst_goal_ratio_1", number(outcome.worst_goal_ratio)},
          {"retuned_beam_rms_mdeg", number(outcome.retuned_rms / millidegree)}};
}

Json plants_json(const std::vector<NotablePlant>& plants) {
  Json list = Json::array();
  for (const auto& plant : plants) list.push_back(plant_json(plant));
  return list;
}

Json law_json(const MonteCarloSection& section) {
  const auto& descriptions = section.law.structure.gains();
  Json gains = Json::array();
  for (std::size_t i = 0; i < section.gains.size(); ++i) {
    gains.push_back({{"symbol", descriptions[i].symbol},
                     {"name", descriptions[i].name},
                     {"unit", descriptions[i].unit},
                     {"value", section.law.gains[i]},
                     {"as_written", section.gains[i]}});
  }
  return {{"structure", section.structure},
          {"source", section.law_source},
          {"gains", std::move(gains)}};
}

Json inputs_json(const MonteCarloSection& section) {
  Json list = Json::array();
  for (const auto input : section.inputs) list.push_back(to_string(input));
  return list;
}

}  // namespace

std::string to_json(const MonteCarloSection& section) {
  Json losses = Json::array();
  for (const auto& [band, loss, climate_loss] : section.losses) {
    losses.push_back({{"band", band.name},
                      {"frequency_Hz", band.frequency},
                      {"beamwidth_mdeg", band.beamwidth / millidegree},
                      {"mean_loss_two_axes_dB", distribution_json(loss)},
                      {"climate_mean_loss_two_axes_dB", optional_json(climate_loss)}});
  }
  Json budgets = Json::array();
  for (const auto& [budget, met] : section.budgets) {
    budgets.push_back({{"name", budget.name},
                       {"band", budget.band},
                       {"convention", budget.convention},
                       {"rms_mdeg", budget.rms / millidegree},
                       {"probability_met_1", estimated(met)}});
  }
  Json goals = Json::array();
  for (const auto& [goal, broken] : section.goals_broken) {
    goals.push_back({{"goal", goal}, {"probability_broken_1", estimated(broken)}});
  }
  Json correlations = Json::array();
  for (const auto& [input, with_rms] : section.correlations) {
    correlations.push_back(
        {{"input", to_string(input)}, {"rank_correlation_1", estimated(with_rms)}});
  }
  Json retuned(nullptr);
  if (section.retuned) {
    retuned = {{"laws_found", section.retuned->found},
               {"unstable_under_held_law", section.retuned->only_retuned},
               {"beam_rms_mdeg", distribution_json(section.retuned->beam_rms, millidegree)},
               {"price_of_one_law_1", distribution_json(section.retuned->price)}};
  }
  const Json json{
      {"program", "boresight"},
      {"version", BORESIGHT_VERSION},
      {"command", "montecarlo"},
      {"case", {{"path", section.case_path}, {"title", section.title}, {"axis", section.axis}}},
      {"seed", section.seed},
      {"interrupted", section.interrupted},
      {"plants_asked", section.plants_asked},
      {"plants", section.plants},
      {"distribution", {{"source", section.distribution}, {"inputs", inputs_json(section)}}},
      {"law", law_json(section)},
      {"wind_model", plant::to_string(section.wind_model)},
      {"wind_speed_m_per_s", section.wind_speed},
      {"stability",
       {{"stable", section.stable},
        {"unstable", section.unstable},
        {"undecided", section.undecided},
        {"probability_not_stable_1", estimated(section.instability)},
        {"confirmed_by_eigenvalues", section.confirmed},
        {"winding_contradicted", section.contradicted},
        {"confirmed_above_peak_1", section.confirm_peak},
        {"confirmed_every", section.confirm_every},
        {"not_stable_plants", plants_json(section.unstable_plants)}}},
      {"beam_rms_mdeg", distribution_json(section.beam_rms, millidegree)},
      {"climate_beam_rms_mdeg", optional_json(section.climate_rms, millidegree)},
      {"bands", std::move(losses)},
      {"budgets", std::move(budgets)},
      {"goals", std::move(goals)},
      {"probability_all_goals_met_1", estimated(section.all_goals_met)},
      {"correlations", std::move(correlations)},
      {"worst_plants", plants_json(section.worst)},
      {"retuned", std::move(retuned)},
      {"assumed_inputs", assumed_json(section.assumed)},
      {"conclusions", section.conclusions},
      {"figures", figures_json(section.figures)}};
  return json.dump(2) + "\n";
}

std::string to_csv(const MonteCarloOutcome& outcome) {
  const auto& section = outcome.section;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "plant,structure_frequency_1,oil_stiffness_1,leakage_rate_1,"
      "friction_slope_N_m_s_per_rad,antenna_inertia_1,motor_inertia_1,wind_torque_1,"
      "standing,beam_rms_mdeg,climate_beam_rms_mdeg,valve_effort_rad_per_s,rate_loop_peak_1,"
      "valve_command_peak_1,position_loop_peak_1,worst_goal_ratio_1,"
      "retuned_beam_rms_mdeg\n");
  // An empty cell for what there is not.
  const auto cell = [&](double value) {
    if (std::isfinite(value)) {
      fmt::format_to(out, ",{}", value);
    } else {
      text.push_back(',');
    }
  };
  const auto& run = *outcome.run;
  for (std::size_t block = 0; block < run.blocks(); ++block) {
    if (!run.whole(block)) continue;
    std::uint64_t index = block * design::MonteCarloRun::block_size;
    for (const auto& one : run.outcomes(block)) {
      fmt::format_to(out, "{}", index);
      for (const double value : outcome.distribution->draw(section.seed, index).values) cell(value);
      fmt::format_to(out, ",{}", standing_text(one.standing));
      cell(one.beam_rms / millidegree);
      cell(one.climate_rms / millidegree);
      cell(one.valve_effort);
      for (const double peak : one.sensitivity_peaks) cell(peak);
      cell(one.worst_goal_ratio);
      cell(one.retuned_rms / millidegree);
      text.push_back('\n');
      ++index;
    }
  }
  return fmt::to_string(text);
}

}  // namespace boresight::app
