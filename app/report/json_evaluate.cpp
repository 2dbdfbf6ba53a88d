
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

template <typename Number>
Json optional_number(const std::optional<Number>& value, double unit = 1.0) {
  return value ? number(*value / unit) : Json(nullptr);
}

Json law_json(const CandidateLaw& law, const std::vector<std::string>& written) {
  const auto& descriptions = law.design.tuning.law.structure.gains();
  Json gains = Json::array();
  for (std::size_t i = 0; i < written.size(); ++i) {
    gains.push_back({{"symbol", descriptions[i].symbol},
                     {"name", descriptions[i].name},
                     {"value", written[i]}});
  }
  return {{"structure", law.structure},
          {"goals_met", law.goals_met},
          {"ensemble_rms_mdeg", number(law.member_rms / millidegree)},
          {"nonlinear_factor_1", number(law.nonlinear_factor())},
          {"compared_rms_mdeg", number(law.compared_rms() / millidegree)},
          {"time_domain", law.time_domain ? json_of(*law.time_domain) : Json(nullptr)},
          {"gains_as_written", std::move(gains)},
          {"design", law.stable() ? design_json(law.design) : Json(nullptr)},
          {"ensemble", law.ensemble ? ensemble_json(*law.ensemble) : Json(nullptr)}};
}

Json slew_json(const SlewFigures& slew) {
  return {{"distance_deg", slew.distance / degree},
          {"rate_deg_per_s", number(slew.rate / degree)},
          {"rate_asked_deg_per_s", number(slew.rate_asked / degree)},
          {"acceleration_deg_per_s2", number(slew.acceleration / degree)},
          {"reachable_acceleration_deg_per_s2", number(slew.reachable_acceleration / degree)},
          {"time_s", optional_number(slew.time)}};
}

Json figures_json(const EvaluateSection& section, const Candidate& candidate,
                  const CandidateFigures& figures) {
  Json bands = Json::array();
  for (std::size_t i = 0; i < section.bands.size(); ++i) {
    bands.push_back(
        {{"name", section.bands[i].name},
         {"mean_loss_two_axes_dB", number(figures.losses[i])},
         {"climate_mean_loss_two_axes_dB",
          figures.climate_losses.empty() ? Json(nullptr) : number(figures.climate_losses[i])}});
  }
  Json budgets = Json::array();
  const CandidateLaw* law = candidate.chosen_law();
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    Json met = nullptr;
    if (law != nullptr && i < law->budgets_met.size()) {
      if (const auto& plants = law->budgets_met[i]) met = *plants;
    }
    budgets.push_back(
        {{"name", section.budgets[i].name},
         {"band", section.budgets[i].band},
         {"wind_speed_limit_m_per_s", number(figures.speed_limits[i])},
         {"needed_wind_speed_m_per_s", optional_number(section.budgets[i].wind_speed)},
         {"plants_met", std::move(met)}});
  }
  return {{"climate_beam_rms_mdeg", optional_number(figures.climate_rms, millidegree)},
          {"bands", std::move(bands)},
          {"budgets", std::move(budgets)},
          {"supply_margin_1", number(figures.supply_margin)},
          {"gust_stroke_margin_1", number(figures.demand_margin)},
          {"slew_rate_margin_1", optional_number(figures.slew_rate_margin)},
          {"reversal_beam_error_mdeg", optional_number(candidate.reversal_error(), millidegree)},
          {"slew", figures.slew ? slew_json(*figures.slew) : Json(nullptr)}};
}

Json candidate_json(const EvaluateSection& section, const Candidate& candidate) {
  Json changes = Json::array();
  for (const auto& change : candidate.changes) {
    changes.push_back({{"key", change.key},
                       {"from", change.before},
                       {"to", change.after},
                       {"basis", to_string(change.basis)},
                       {"source", text_or_null(change.source)}});
  }
  Json consequences = Json::array();
  for (const auto& one : candidate.consequences) {
    consequences.push_back({{"quantity", one.quantity},
                            {"unit", one.unit},
                            {"before_1", number(one.before)},
                            {"after_1", number(one.after)},
                            {"follows_from", one.follows_from}});
  }
  Json laws = Json::array();
  for (std::size_t i = 0; i < candidate.laws.size(); ++i) {
    laws.push_back(law_json(candidate.laws[i], candidate.gains.at(i)));
  }
  return {{"name", candidate.name},
          {"path", text_or_null(candidate.path)},
          {"description", candidate.description},
          {"cost_1", optional_number(candidate.cost)},
          {"cost_uncertainty_1", number(candidate.cost_uncertainty)},
          {"cost_assumed", candidate.cost_assumed},
          {"risks", candidate.risks},
          {"changes", std::move(changes)},
          {"consequences", std::move(consequences)},
          {"reflected_inertia_kg_m2", number(candidate.reflected_inertia)},
          {"motor_inertia_kg_m2", number(candidate.motor_inertia)},
          {"motor_to_load_ratio_1", number(candidate.motor_to_load_ratio)},
          {"oil_mode", mode_json(candidate.oil_mode)},
          {"feasible", candidate.feasible()},
          {"chosen_structure",
           candidate.chosen ? Json(candidate.laws[*candidate.chosen].structure) : Json(nullptr)},
          {"laws", std::move(laws)},
          {"figures", candidate.figures ? figures_json(section, candidate, *candidate.figures)
                                        : Json(nullptr)}};
}

}  // namespace

Json evaluate_json(const EvaluateSection& section) {
  Json candidates = Json::array();
  for (const auto& candidate : section.candidates) {
    candidates.push_back(candidate_json(section, candidate));
  }
  Json front = Json::array();
  for (const std::size_t i : section.front) front.push_back(section.candidates[i].name);
  Json json{
      {"wind_speed_m_per_s", section.wind_speed},
      {"wind_model", plant::to_string(section.wind_model)},
      {"wind_climate_stated", section.climate},
      {"rms_over", section.minimises_climate ? "climate" : "design_speed"},
      {"compared_on", section.time_domain ? "nonlinear_antenna" : "linear_plant"},
      {"currency", section.currency},
      {"ensemble_source", section.ensemble_source},
      {"ensemble_members", section.ensemble_size},
      {"starts", section.starts},
      {"candidates", std::move(candidates)},
      {"front", std::move(front)},
      {"decision", section.decision ? decision_json(section, *section.decision) : Json(nullptr)},
      {"not_run", section.not_run}};
  if (section.wind_mast) json["wind_mast"] = mast_json(*section.wind_mast);
  return json;
}

}  // namespace boresight::app
