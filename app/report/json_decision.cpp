#include <boresight/app/report/evaluate_report.hpp>

namespace boresight::app {
namespace {

Json share_json(const design::Probability& probability) {
  return {{"value_1", number(probability.value)},
          {"lower_95_1", number(probability.lower)},
          {"upper_95_1", number(probability.upper)}};
}

Json index_json(const numerics::EstimatedIndex& index) {
  return {{"value_1", number(index.value)},
          {"standard_error_1", number(index.standard_error)},
          {"lower_95_1", number(index.lower)},
          {"upper_95_1", number(index.upper)}};
}

Json options_json(const EvaluateSection& section, const DecisionSection& decision) {
  Json options = Json::array();
  for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
    const auto& one = decision.candidates[i];
    const auto& statistics = decision.statistics.options[i];
    Json quantiles = Json::array();
    for (const auto& quantile : statistics.quantiles) {
      quantiles.push_back({{"share_1", quantile.share},
                           {"value_mdeg", number(quantile.value)},
                           {"lower_95_mdeg", number(quantile.lower)},
                           {"upper_95_mdeg", number(quantile.upper)}});
    }
    options.push_back({{"name", section.candidates[one.candidate].name},
                       {"mean_mdeg", number(statistics.mean)},
                       {"standard_error_mdeg", number(statistics.standard_error)},
                       {"quantiles", std::move(quantiles)},
                       {"is_best", share_json(statistics.best)},
                       {"expected_regret_mdeg", number(statistics.expected_regret)},
                       {"regret_error_mdeg", number(statistics.regret_error)},
                       {"on_front_share_1", decision.front_shares[i]},
                       {"outside_goals", share_json(one.outside_goals)},
                       {"unstable", share_json(one.unstable)}});
  }
  return options;
}

Json pairs_json(const EvaluateSection& section, const DecisionSection& decision) {
  const auto name = [&](std::size_t place) {
    return section.candidates[decision.candidates[place].candidate].name;
  };
  Json pairs = Json::array();
  for (const auto& pair : decision.statistics.pairs) {
    pairs.push_back({{"first", name(pair.first)},
                     {"second", name(pair.second)},
                     {"first_is_better", share_json(pair.better)},
                     {"mean_gain_mdeg", number(pair.mean_gain)},
                     {"gain_error_mdeg", number(pair.gain_error)},
                     {"first_over_second", design::to_string(pair.first_over_second)},
                     {"second_over_first", design::to_string(pair.second_over_first)}});
  }
  return pairs;
}

Json by_structure_json(const EvaluateSection& section, const DecisionSection& decision) {
  Json pairs = Json::array();
  for (const auto& pair : decision.by_structure) {
    Json structures = Json::array();
    for (const auto& one : pair.structures) {
      structures.push_back({{"structure", one.structure},
                            {"first_is_better", share_json(one.better)},
                            {"mean_gain_mdeg", number(one.mean_gain)},
                            {"gain_error_mdeg", number(one.gain_error)},
                            {"first_usable", one.first_usable},
                            {"second_usable", one.second_usable}});
    }
    pairs.push_back(
        {{"first", section.candidates[decision.candidates[pair.first].candidate].name},
         {"second", section.candidates[decision.candidates[pair.second].candidate].name},
         {"structures", std::move(structures)}});
  }
  return pairs;
}

Json inputs_json(const DecisionSection& decision) {
  Json inputs = Json::array();
  for (std::size_t k = 0; k < decision.inputs.size(); ++k) {
    Json input{{"name", decision.inputs[k]}};
    input["tornado"] = nullptr;
    if (decision.tornado) {
      for (const auto& bar : decision.tornado->bars) {
        if (bar.input != k) continue;
        input["tornado"] = {{"at_5_percent_mdeg", number(bar.at_low)},
                            {"at_95_percent_mdeg", number(bar.at_high)},
                            {"swing_mdeg", number(bar.swing)}};
      }
    }
    input["sobol"] = nullptr;
    if (decision.sobol) {
      const auto& indices = decision.sobol->outputs.front().inputs[k];
      input["sobol"] = {{"first_order", index_json(indices.first_order)},
                        {"total", index_json(indices.total)}};
    }
    input["test_value"] = nullptr;
    if (decision.tests) {
      const auto& test = decision.tests->inputs[k];
      input["test_value"] = {{"fitted_gain_mdeg", number(test.fitted.gain)},
                             {"fitted_error_mdeg", number(test.fitted.standard_error)},
                             {"held_out_gain_mdeg", number(test.held_out_gain)},
                             {"held_out_error_mdeg", number(test.held_out_error)}};
    }
    inputs.push_back(std::move(input));
  }
  return inputs;
}

}  // namespace

Json decision_json(const EvaluateSection& section, const DecisionSection& decision) {
  const auto name = [&](std::size_t place) {
    return section.candidates[decision.candidates[place].candidate].name;
  };
  Json perfect = nullptr;
  if (decision.tests) {
    perfect = {{"gain_mdeg", number(decision.tests->perfect.gain)},
               {"standard_error_mdeg", number(decision.tests->perfect.standard_error)}};
  }
  return {{"draws", decision.draws},
          {"source", decision.source},
          {"options", options_json(section, decision)},
          {"pairs", pairs_json(section, decision)},
          {"pairs_by_structure", by_structure_json(section, decision)},
          {"least_mean_rms", name(decision.best)},
          {"second_least_mean_rms", name(decision.second)},
          {"difference_at_median_mdeg",
           decision.tornado ? number(decision.tornado->at_median) : Json(nullptr)},
          {"inputs", inputs_json(decision)},
          {"knowing_everything", std::move(perfect)},
          {"notes", decision.notes}};
}

}  // namespace boresight::app
