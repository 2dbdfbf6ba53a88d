#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/io/description/estimates.hpp>
#include <boresight/io/description/time_domain_results.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

using io::describe_distribution;
using io::describe_estimate;

void describe_sample(io::Visitor& v, const design::PlantSample& draw) {
  using enum design::UncertainInput;
  v.defined_as("inputs",
               "Factors on the numbers of the case (of the records' estimate, where there are "
               "records); the slope of friction at the motor shaft.");
  v.number("structure_frequency", draw[structure_frequency], unit::ratio,
           "On the frequencies of locked rotor and modes.");
  v.number("oil_stiffness", draw[oil_stiffness], unit::ratio, "On the oil spring.");
  v.number("leakage_rate", draw[leakage_rate], unit::ratio, "On the leakage rate.");
  v.number("friction_slope", draw[friction_slope], {.suffix = "N_m_s_per_rad"},
           "Torque per rate at the motor shaft.");
  v.number("antenna_inertia", draw[antenna_inertia], unit::ratio, "On the antenna's inertia.");
  v.number("motor_inertia", draw[motor_inertia], unit::ratio,
           "On the motors' inertia, flywheels included.");
  v.number("wind_torque", draw[wind_torque], unit::ratio, "On the wind torque.");
  v.number("valve_frequency", draw[valve_frequency], unit::ratio, "On the valve's frequency.");
}

void describe_plant(io::Visitor& v, const NotablePlant& plant) {
  const auto& outcome = plant.outcome;
  v.defined_as("plant", "Sample number `index` of the seed.");
  v.count("index", plant.index, "From 0.");
  v.group("inputs", "The sample.", [&] { describe_sample(v, plant.draw); });
  v.word("stability_verdict", stability_text(outcome.stability_basis),
         {"stable", "unstable", "undecided"},
         "Whether the loop is stable; undecided: by less than what the rational dead time leaves "
         "out.");
  v.number("boresight_rms", outcome.boresight_rms, unit::millidegree,
           "In the design wind, per axis.");
  v.number("climate_boresight_rms", outcome.climate_rms, unit::millidegree,
           "Over the site's wind climate.");
  v.number("control_effort", outcome.control_effort, unit::radian_per_second,
           "Rms of the valve command from the sensors' noise.");
  v.numbers("sensitivity_peaks", outcome.sensitivity_peaks, unit::ratio,
            "Rate loop alone, valve command, position loop.", {}, {.minimum = 3, .maximum = 3});
  v.number("worst_constraint", outcome.worst_constraint, unit::ratio,
           "Largest value/limit of the constraints.");
  v.number("retuned_boresight_rms", outcome.retuned_rms, unit::millidegree,
           "With gains tuned for this plant.");
}

// A gain of the controller that is held.
struct FixedGain {
  std::string symbol, name, unit;
  double value = 0.0;
  std::string as_written;
};

void describe_controller(io::Visitor& v, const MonteCarloSection& section) {
  std::vector<FixedGain> gains;
  for (std::size_t i = 0; i < section.gains.size(); ++i) {
    const auto& gain = section.controller.structure.gains().at(i);
    gains.push_back(
        {gain.symbol, gain.name, gain.unit, section.controller.gains.at(i), section.gains[i]});
  }
  v.text("structure", section.structure, "As the user names it.");
  v.text("source", section.controller_source, "Where the gains come from.");
  v.list("gains", gains, "Fixed on every plant.", [&](const FixedGain& gain) {
    v.text("symbol", gain.symbol, "Its symbol.");
    v.text("name", gain.name, "Its name.");
    v.text("unit", gain.unit, "Of the value: SI.");
    v.number("value", gain.value, unit::none, "In that unit.", {.above = 0.0, .finite = true});
    v.text("as_written", gain.as_written, "In the engineer's units.");
  });
}

void describe_stability(io::Visitor& v, const MonteCarloSection& section) {
  v.count("stable", section.stable, "Plants whose loop is stable.");
  v.count("unstable", section.unstable, "Plants whose loop is not.");
  v.count("undecided", section.undecided, "Plants for which it is undecided.");
  describe_estimate(v, "probability_not_stable", section.instability, unit::ratio,
                    "Of a sampled plant, undecided ones counted.");
  v.count("confirmed_by_eigenvalues", section.confirmed, "Plants whose poles were computed.");
  v.count("encirclements_contradicted", section.contradicted,
          "Of these, those that contradict the Nyquist criterion.");
  v.number("confirmed_above_peak", section.confirm_peak, unit::ratio,
           "Ms above which poles are computed.");
  v.count("confirmed_every", section.confirm_every, "Of the other plants, one in so many.");
  v.list("not_stable_plants", section.unstable_plants, "The first thousand; --csv has all.",
         [&](const NotablePlant& plant) { describe_plant(v, plant); },
         {.maximum = MonteCarloSection::max_listed});
}

void describe_pointing(io::Visitor& v, const MonteCarloSection& section) {
  describe_distribution(v, "boresight_rms", section.boresight_rms, unit::millidegree,
                        "In the design wind, per axis.");
  describe_distribution(v, "climate_boresight_rms", section.climate_rms, unit::millidegree,
                        "Over the site's wind climate; null without one.");
  v.list("bands", section.losses, "Of the antenna.", [&](const MonteCarloSection::BandLoss& loss) {
    v.text("band", loss.band.name, "Its name.");
    v.number("frequency", loss.band.frequency, unit::hertz, "Of the carrier.");
    v.number("beamwidth", loss.band.beamwidth, unit::millidegree, "At half power.");
    describe_distribution(v, "mean_loss_two_axes", loss.loss, unit::decibel_as_kept,
                          "Over two equal axes, in the design wind.");
    describe_distribution(v, "climate_mean_loss_two_axes", loss.climate_loss, unit::decibel_as_kept,
                          "The same over the site's wind climate; null without one.");
  });
  v.object(
      "effect", section.effect,
      "Of a simulation on the case's own plant: budgets are evaluated by it, of a factor of at "
      "least 1.");
  v.list("budgets", section.budgets, "Pointing budgets.",
         [&](const MonteCarloSection::BudgetProbability& probability) {
           v.text("name", probability.budget.name, "Its name.");
           v.text("band", probability.budget.band, "Frequency band.");
           v.text("convention", probability.budget.convention, "What the loss is taken of.");
           v.number("rms", probability.budget.rms, unit::millidegree, "Allowed, one axis.");
           describe_estimate(v, "probability_met", probability.met, unit::ratio,
                             "In the design wind; no unstable plant meets one.");
         });
  v.list("constraints", section.constraints_violated, "Constraints.",
         [&](const MonteCarloSection::ConstraintProbability& probability) {
           v.text("constraint", probability.goal, "Which.");
           describe_estimate(v, "probability_broken", probability.broken, unit::ratio,
                             "By a stable plant, among all plants.");
         });
}

void describe_retuned(io::Visitor& v, const MonteCarloSection::Retuned& retuned) {
  v.count("controllers_found", retuned.found,
          "Plants for which gains that meet the constraints were found.");
  v.count("unstable_with_fixed_gains", retuned.only_retuned,
          "Of these, those unstable with the fixed gains.");
  describe_distribution(v, "boresight_rms", retuned.boresight_rms, unit::millidegree,
                        "With these gains.");
  describe_distribution(v, "cost_of_fixed_gains", retuned.fixed_gain_cost, unit::ratio,
                        "Rms with fixed gains over rms with plant-specific gains, minus 1.");
}

}  // namespace

void describe(io::Visitor& v, const MonteCarloSection& section) {
  describe_origin(v, "montecarlo");
  describe_case(v, section.case_path, section.title, section.axis);
  v.count("seed", section.seed, "Of all samples.");
  v.flag("interrupted", section.interrupted,
         "The user stopped the work: results cover the plants evaluated by then.");
  v.count("plants_asked", section.plants_asked, "Requested.");
  v.count("plants", section.plants, "Evaluated.");
  v.group("distribution", "Of the plants.", [&] {
    std::vector<std::string> inputs;
    for (const auto input : section.inputs) inputs.emplace_back(to_string(input));
    v.text("source", section.distribution, "Distribution that they are sampled from.");
    v.texts("inputs", inputs, "That vary.");
  });
  v.group("controller", "Evaluated on every plant.", [&] { describe_controller(v, section); });
  v.word("wind_model", plant::to_string(section.wind_model),
         {to_string(plant::WindModel::uniform), to_string(plant::WindModel::vickery),
          to_string(plant::WindModel::coherence)},
         "Of the wind torque.");
  v.number("wind_speed", section.wind_speed, unit::metre_per_second, "Mean, of the design wind.");
  v.group("stability", "Of the loop on each plant.", [&] { describe_stability(v, section); });
  describe_pointing(v, section);
  describe_estimate(v, "probability_all_constraints_met", section.all_constraints_met, unit::ratio,
                    "Of a sampled plant.");
  v.list("correlations", section.correlations, "Of inputs with the boresight rms.",
         [&](const MonteCarloSection::Correlation& one) {
           v.text("input", to_string(one.input), "Which.");
           describe_estimate(v, "rank_correlation", one.with_rms, unit::ratio,
                             "Spearman's, over stable plants.");
         });
  v.list("worst_plants", section.worst, "Stable plants of largest boresight rms.",
         [&](const NotablePlant& plant) { describe_plant(v, plant); });
  v.optional_group(
      "retuned", section.retuned, "Plant-specific gains; null without --retune.",
      [&](const MonteCarloSection::Retuned& retuned) { describe_retuned(v, retuned); });
  describe_assumed(v, section.assumed);
  v.texts("conclusions", section.conclusions, "What the numbers mean, in sentences.");
  describe_figures(v, section.figures);
  describe_renamed_keys(v);
}

std::string to_json(const MonteCarloSection& section) {
  return json_of(section).dump(2) + "\n";
}

}  // namespace boresight::app
