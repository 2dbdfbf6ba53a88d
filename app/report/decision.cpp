#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/study_decision.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/identification/grey_box/stated_number_check.hpp>
#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/recommended_values.hpp>

namespace boresight::app {
namespace {

using Sentences = std::vector<std::string>;

std::string audited(const AuditReport& report) {
  const std::size_t departing = report.findings.size();
  if (departing > 0) {
    return fmt::format(
        "{} of {} stated values {} inconsistent with the case: correct those that change a "
        "headline result.",
        departing, report.checked, departing == 1 ? "is" : "are");
  }
  const bool sound = report.implausible.empty();
  if (report.checked == 0) {
    return std::string("The case states no derived numbers to compare") +
           (sound ? ", and nothing in it is physically implausible." : ".");
  }
  return (report.checked == 1
              ? "The one stated derived value is consistent"
              : fmt::format("All {} stated derived values are consistent", report.checked)) +
         (sound ? ": design on the case." : ".");
}

// Assumed inputs that move the rms of a redesign by what decides anything, the largest first.
std::vector<std::string> telling_inputs(const TuningSection& section) {
  std::vector<std::string> keys;
  for (const auto& effect : section.input_effects) {
    if (effect.quantity.basis != io::Basis::assumed) continue;
    if (effect.change(section.design.boresight_rms) >= negligible_change) {
      keys.push_back(effect.quantity.key);
    }
  }
  return keys;
}

std::string dependence(const Report& report) {
  if (report.command == "identify") {
    return ", and enter the identification";
  }
  if (!report.tuning) return "; `boresight redesign` ranks them by their effect on the rms";
  constexpr std::size_t maximum = 3;
  std::vector<std::string> keys = telling_inputs(*report.tuning);
  const std::size_t count = keys.size();
  keys.resize(std::min(maximum, count));
  if (count == 0) {
    return fmt::format("; none moves the rms by {:.0f} % or more", 100.0 * negligible_change);
  }
  // Only the largest effects are kept.
  const auto& last = report.tuning->input_effects.back();
  const bool more = last.change(report.tuning->design.boresight_rms) >= negligible_change;
  return fmt::format("; {}{} of them move{} the rms by {:.0f} % or more, {}{}",
                     more ? "at least " : "", count, count == 1 ? "s" : "",
                     100.0 * negligible_change, count > maximum ? "first " : "",
                     fmt::join(keys, ", "));
}

// What the result depends on, and what the records have taken off that list.
std::string assumptions(const Report& report) {
  const std::size_t count = count_of_antenna(report.assumed);
  const auto superseded = std::ranges::count_if(report.superseded, &io::SupersededInput::assumed);
  std::string text = count == 0
                         ? std::string("No antenna input is assumed")
                         : fmt::format("{} antenna input{} assumed, in value or in uncertainty{}",
                                       count, count == 1 ? " is" : "s are", dependence(report));
  if (superseded > 0) text += fmt::format(". The records replaced {} assumed inputs", superseded);
  return text + '.';
}

Sentences audit_decision(const AuditReport& report) {
  Sentences sentences{audited(report)};
  const auto& findings = report.findings;
  const design::Finding* largest = nullptr;
  double change = 0.0;
  for (const auto& finding : findings) {
    for (const auto& derived_quantity : finding.derived_quantities) {
      if (std::abs(derived_quantity.relative_change()) <= change) continue;
      change = std::abs(derived_quantity.relative_change());
      largest = &finding;
    }
  }
  if (largest != nullptr) {
    sentences.push_back(fmt::format(
        "{} '{}' changes a headline result most, by {:.3g} %.", largest->id,
        largest->forms.empty() ? std::string() : largest->forms.front().text, 100.0 * change));
  }
  if (!report.implausible.empty()) {
    sentences.push_back(fmt::format(
        "{}. {} before designing on the case.", failing_checks(report.implausible),
        report.implausible.size() == 1 ? "Explain or correct it" : "Explain or correct each"));
  }
  return sentences;
}

// "record 'a'", "records 'a', 'b' and 3 more".
std::string names_of(const std::vector<std::string>& names, const std::string& what) {
  constexpr std::size_t maximum = 2;
  std::string text = fmt::format(
      "{}{} '{}'", what, names.size() == 1 ? "" : "s",
      fmt::join(std::vector(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(
                                                               std::min(maximum, names.size()))),
                "', '"));
  if (names.size() > maximum) text += fmt::format(" and {} more", names.size() - maximum);
  return text;
}

std::string look_at(const io::ChannelSuspicion& one, const std::string& said) {
  std::string text = "Look at ";
  if (!one.channels.empty()) text += names_of(one.channels, "channel") + " in ";
  const bool again = said.find(one.explanation) != std::string::npos;
  return fmt::format("{}{}: {}{}{}.", text, names_of(one.records, "record"), one.finding,
                     one.record_refused ? ", not used" : "",
                     again ? "" : fmt::format(" ({})", one.explanation));
}

Sentences campaign_decision(const io::CampaignSection& section) {
  constexpr std::size_t maximum = 3;
  Sentences sentences;
  if (const auto values = io::recommended(section)) {
    const auto& [inertia, ratio] = *values;
    sentences.push_back(fmt::format(
        "Design on a reflected inertia of {:.3f} kg m2 (95 % interval {:.3f} to {:.3f}) and a "
        "motor-to-load ratio of {:.2f} ({:.2f} to {:.2f}): {} records agree on them.",
        inertia.value, inertia.lower, inertia.upper, ratio.value, ratio.lower, ratio.upper,
        section.grey_box->records.size()));
    const auto doubtful = identification::departing_numbers(
        section.grey_box->stated_numbers, identification::StatedNumberCheck::doubtful_beyond);
    if (!doubtful.empty()) {
      sentences.push_back(fmt::format("The intervals include that one stated number is wrong: {}.",
                                      io::departures_of(doubtful)));
    }
    if (const auto count = section.contradictions.size(); count > 0) {
      sentences.push_back(fmt::format(
          "The records contradict {} of the case's stated numbers: correct them there.", count));
    }
  } else {
    sentences.push_back(
        fmt::format("No value is recommended ({}).{}{}", to_string(io::rejection(section)),
                    section.contradiction.empty() ? "" : " ", section.contradiction));
    for (const auto& failure : section.failures) {
      if (failure.method != "grey box") continue;
      sentences.push_back(fmt::format("The fit of one model failed: {}.", failure.reason));
    }
  }
  for (const auto& one : io::suspicions(section)) {
    if (sentences.size() >= maximum) break;
    sentences.push_back(look_at(one, section.contradiction));
  }
  if (const auto* const one = io::weakest_check(section);
      one != nullptr && sentences.size() < maximum) {
    sentences.push_back(
        fmt::format("An error in the stated {} would show from {:.1f} % on, where it makes {:.1f} "
                    "% of inertia.",
                    one->name, 100.0 * one->visible_error,
                    100.0 * std::abs(one->inertia_effect) * one->visible_error));
  }
  return sentences;
}

Sentences identify_decision(const Report& report) {
  Sentences sentences;
  if (report.campaign) return campaign_decision(*report.campaign);
  if (report.identification) {
    const auto& methods = report.identification->inertia.methods;
    const auto [minimum, maximum] = std::ranges::minmax_element(
        methods, {}, [](const auto& m) { return m.reflected_inertia.value; });
    if (minimum != methods.end()) {
      sentences.push_back(fmt::format(
          "The methods put the reflected inertia between {:.3f} kg m2 ({}) and {:.3f} ({}).",
          minimum->reflected_inertia.value, minimum->name, maximum->reflected_inertia.value,
          maximum->name));
    }
  }
  return sentences;
}

Sentences model_decision(const PlantSection& plant) {
  Sentences sentences{fmt::format(
      "The hydraulic mode is at {:.3g} Hz, damping ratio {:.2g}; the motor-to-load inertia ratio "
      "is {:.2f}.",
      plant.hydraulic.frequency, plant.hydraulic.damping_ratio, plant.motor_to_load_ratio)};
  if (plant.available_wind_torque > 0.0) {
    sentences.push_back(fmt::format(
        "The mean design wind takes {:.0f} % of the supply torque that friction and offset leave.",
        100.0 * std::abs(plant.mean_wind_torque) / plant.available_wind_torque));
  } else if (plant.supply_torque > 0.0) {
    sentences.emplace_back(
        "Friction at the tracking rate and offset take all supply torque: none is left for the "
        "wind.");
  }
  return sentences;
}

Sentences redesign_decision(const Report& report) {
  Sentences sentences;
  if (report.resonance && report.resonance->contradicts()) {
    sentences.push_back(resonance_sentence(*report.resonance));
  }
  if (report.tuning)
    std::ranges::move(decide_tuning(report, *report.tuning), std::back_inserter(sentences));
  if (report.matching) {
    if (auto text = decide_matching(report, *report.matching); !text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences.empty() ? identify_decision(report) : sentences;
}

}  // namespace

std::vector<std::string> decision(const Report& report) {
  if (report.matched) return decision(*report.matched);
  if (report.evaluated) return decision(*report.evaluated);
  if (report.measured) {
    return {report.conclusions.begin(),
            report.conclusions.begin() +
                static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, report.conclusions.size()))};
  }
  if (report.tuned) {
    auto sentences = decision(*report.tuned, report.time_domain, report.limit);
    if (report.state_space && report.time_domain) {
      if (auto text = state_space_advantage(*report.state_space, *report.time_domain);
          !text.empty()) {
        sentences.push_back(std::move(text));
      }
    }
    if (sentences.size() < 3) sentences.push_back(assumptions(report));
    return sentences;
  }
  Sentences sentences;
  if (report.command == "redesign") {
    sentences = redesign_decision(report);
  } else if (report.audit) {
    sentences = audit_decision(*report.audit);
  } else if (report.identification || report.campaign) {
    sentences = identify_decision(report);
  } else if (report.plant) {
    sentences = model_decision(*report.plant);
  }
  if (sentences.size() < 3 && report.command != "redesign" && report.command != "audit") {
    sentences.push_back(assumptions(report));
  }
  return sentences;
}

std::vector<std::string> reservations(const Report& report) {
  Sentences sentences;
  if (report.command != "redesign") {
    if (auto text = resonance_warning(report.resonance); !text.empty()) sentences = {text};
    if (!report.tuned) return sentences;
    const TunedController* controller = recommended_tuned_controller(*report.tuned);
    if (controller == nullptr) return sentences;
    std::ranges::move(about_bounds(*report.tuned, report.tuned->gain_units, {controller}),
                      std::back_inserter(sentences));
    return sentences;
  }
  if (report.tuning) sentences = tuning_reservations(report, *report.tuning);
  sentences.push_back(assumptions(report));
  return sentences;
}

}  // namespace boresight::app
