#include <vector>

#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/io/description/design_results.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm positive{.least = 0.0};
constexpr io::NumberForm above_zero{.above = 0.0, .finite = true};
constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};

// A loop tuned at one motor inertia.
struct MatchingPoint {
  MatchingRow row;
  design::Design design;
};

void describe_choice(io::Visitor& v, const ChoiceResult& choice) {
  v.text("name", choice.name, "The choice.");
  v.text("says", choice.says, "What it takes from where.");
  v.number("oil_stiffness", choice.oil_stiffness, {.suffix = "N_m_per_rad"}, "Of the oil spring.",
           {.above = 0.0});
  v.number("reflected_inertia", choice.reflected_inertia, inertia_unit, "At the motor shaft.");
  v.number("motor_to_load_ratio", choice.motor_to_load_ratio, unit::ratio,
           "Motors over load; without meaning where the inertia is below that of the motors.");
  v.text_or_null("impossible_because", choice.impossible,
                 "Why there is no plant; null where there is one.");
  v.numbers_if("speed_limits", choice.speed_limits.has_value(),
               choice.speed_limits.value_or(std::vector<double>{}), unit::metre_per_second,
               "Mean wind speeds up to which this choice's law meets each budget on its plant, "
               "gains held; null as a whole without a plant or a stable law, null of a budget that "
               "is met in all winds looked at.",
               positive);
  v.object("design", choice.design, "Its law; null where there is no plant.");
}

void describe_point(io::Visitor& v, const MatchingPoint& point) {
  const MatchingRow& row = point.row;
  v.text("label", row.label, "Number of disks, or 'ratio 1'.");
  v.number("flywheel_disks", row.disks, unit::ratio, "On each motor; not whole at ratio 1.",
           {.least = 0.0, .finite = true});
  v.number("motor_inertia", row.motor_inertia, inertia_unit, "All motors.", above_zero);
  v.number("reflected_inertia", row.reflected_inertia, inertia_unit, "Motors and load.",
           above_zero);
  v.number("motor_to_load_ratio", row.motor_to_load_ratio, unit::ratio, "Motors over load.",
           positive);
  v.object("design", point.design, "The loop tuned there.");
}

void describe_series(io::Visitor& v, const MatchingSection& section, const MatchingSeries& series) {
  v.word("structure", control::to_string(series.structure), {"PI without lag", "PI with lag"},
         "Loop structure.");
  v.text("friction", friction_text(series), "Which friction.");
  v.number("viscous_friction", series.viscous_friction, {.suffix = "N_m_s_per_rad"},
           "Slope of that friction.", {.finite = true});
  std::vector<MatchingPoint> points;
  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    points.push_back({section.rows[i], series.designs[i]});
  }
  v.list("points", points, "By number of disks.",
         [&](const MatchingPoint& point) { describe_point(v, point); }, {.least = 2});
}

}  // namespace

void describe_choices(io::Visitor& v, const std::vector<ChoiceResult>& choices) {
  v.list("choices", choices,
         "The loop tuned on what other choices among contradictory numbers make of the plant.",
         [&](const ChoiceResult& choice) { describe_choice(v, choice); }, {.least = 1});
}

void describe_matching(io::Visitor& v, const MatchingSection& section) {
  v.list("matching", section.series,
         "The loops tuned again at each number of flywheel disks, by loop structure and friction.",
         [&](const MatchingSeries& series) { describe_series(v, section, series); }, {.least = 1});
}

}  // namespace boresight::app
