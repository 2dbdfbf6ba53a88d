#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/proposal_effects.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

// NaN without a stable law.
double rms_of(const Candidate& candidate) {
  const CandidateLaw* law = candidate.chosen_law();
  return law == nullptr ? std::numeric_limits<double>::quiet_NaN() : law->compared_rms();
}

// What has no cost may cost anything.
double cost_of(const Candidate& candidate) {
  return candidate.cost.value_or(std::numeric_limits<double>::infinity());
}

std::string share(const design::Probability& probability) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", probability.value, probability.lower,
                     probability.upper);
}

const std::string& name_of(const EvaluateSection& section, const DecisionSection& decision,
                           std::size_t place) {
  return section.candidates[decision.candidates[place].candidate].name;
}

std::string against_as_it_is(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const CandidateLaw* law = base.chosen_law();
  if (!base.path.empty() || law == nullptr || !std::isfinite(rms_of(base))) return "";
  std::vector<std::string> better, worse;
  for (const auto& candidate : section.candidates) {
    if (candidate.path.empty() || !candidate.feasible() || !std::isfinite(rms_of(candidate))) {
      continue;
    }
    const double change = rms_of(candidate) / rms_of(base) - 1.0;
    auto& list = change < 0.0 ? better : worse;
    list.push_back(fmt::format("{:.1f} % by {}", 100.0 * std::abs(change), candidate.name));
  }
  std::string text = fmt::format(
      "Conditions: {} loops on the antenna as it is, {} wind at {:g} m/s, gains re-tuned for each "
      "proposal{}. Root-mean-square beam error over the plants against the antenna as it is, "
      "re-tuned ({:.4f} mdeg): ",
      law->structure, plant::to_string(section.wind_model), section.wind_speed,
      section.time_domain
          ? ", each rms of linear loops raised by what friction, orifices, limits and all else "
            "that is not linear did to that law in a simulated record"
          : ", linear loops only",
      rms_of(base) / millidegree);
  text += better.empty() ? "nothing lowers it" : fmt::format("lowered {}", fmt::join(better, ", "));
  if (!worse.empty()) text += fmt::format("; raised or left {}", fmt::join(worse, ", "));
  return text + ".";
}

// What the nonlinear antenna makes of the laws: the widest spread of factors, what hunts, and where
// it chose another structure or order than the linear plant.
std::string in_the_time_domain(const EvaluateSection& section) {
  if (!section.time_domain) return "";
  std::vector<std::string> factors, hunting, failed;
  const Candidate* linear = nullptr;
  const Candidate* simulated = nullptr;
  for (const auto& candidate : section.candidates) {
    const CandidateLaw* law = candidate.chosen_law();
    if (law == nullptr || !law->time_domain) continue;
    if (!std::isfinite(law->nonlinear_factor())) {
      failed.push_back(candidate.name);
      continue;
    }
    factors.push_back(fmt::format("{} {:.2f}", candidate.name, law->nonlinear_factor()));
    double amplitude = 0.0;
    for (const auto& one : law->time_domain->hunting) {
      if (one.limit_cycle) amplitude = std::max(amplitude, one.beam_amplitude);
    }
    if (amplitude > 0.0) {
      hunting.push_back(fmt::format("{} +-{:.2f}", candidate.name, amplitude / millidegree));
    }
    if (!law->usable()) continue;
    if (linear == nullptr || law->member_rms < linear->chosen_law()->member_rms)
      linear = &candidate;
    if (simulated == nullptr || rms_of(candidate) < rms_of(*simulated)) simulated = &candidate;
  }
  std::string text;
  if (!factors.empty()) {
    text = fmt::format("Simulated rms over that of the linear plant in the same record: {}.",
                       fmt::join(factors, ", "));
  }
  if (linear != simulated && linear != nullptr && simulated != nullptr) {
    text += fmt::format(" Linear loops would put {} first; on the nonlinear antenna it is {}.",
                        linear->name, simulated->name);
  }
  if (!hunting.empty()) {
    text += fmt::format(" Limit cycles of the beam (mdeg, at rest or tracking): {}.",
                        fmt::join(hunting, ", "));
  }
  if (!failed.empty()) {
    text += fmt::format(" Did not complete their run, and are not compared: {}.",
                        fmt::join(failed, ", "));
  }
  return text;
}

std::string on_the_front(const EvaluateSection& section) {
  if (section.front.empty()) return "";
  std::vector<std::string> steps;
  for (std::size_t k = 0; k < section.front.size(); ++k) {
    const auto& candidate = section.candidates[section.front[k]];
    std::string step = fmt::format("{} ({:g} {}, {:.4f} mdeg)", candidate.name, cost_of(candidate),
                                   section.currency, rms_of(candidate) / millidegree);
    if (k > 0) {
      const auto& before = section.candidates[section.front[k - 1]];
      const double gained = (rms_of(before) - rms_of(candidate)) / millidegree;
      const double paid = cost_of(candidate) - cost_of(before);
      const double share = 1.0 - rms_of(candidate) / rms_of(before);
      if (share < negligible_change) {
        step += fmt::format(", only {:.1f} % less than the one before: nothing to pay for",
                            100.0 * share);
      } else if (gained > 0.0 && paid > 0.0) {
        step += fmt::format(", {:.0f} {} for each mdeg more", paid / gained, section.currency);
      }
    }
    steps.push_back(std::move(step));
  }
  const bool assumed = std::ranges::any_of(
      section.candidates, [](const auto& candidate) { return candidate.cost_assumed; });
  return fmt::format(
      "On the front of cost and rms, each better than all that cost less: {}.{} A proposal off the "
      "front is dearer and no better than one on it.",
      fmt::join(steps, "; "), assumed ? " Costs marked as assumed were quoted by nobody." : "");
}

std::string without_cost(const EvaluateSection& section) {
  std::vector<std::string> names;
  for (const auto& candidate : section.candidates) {
    if (!candidate.path.empty() && !candidate.cost) names.push_back(candidate.name);
  }
  if (names.empty()) return "";
  return section.currency.empty()
             ? std::string(
                   "No proposal states a cost ([cost] of its file): they are compared by "
                   "what they do, and there is no front of cost and rms.")
             : fmt::format("Without a cost ([cost] of its file), and so not on the front: {}.",
                           fmt::join(names, ", "));
}

// What of the choice by the least mean is not worth paying for.
std::string not_worth_paying(const EvaluateSection& section, const DecisionSection& decision) {
  const std::size_t choice = worth_its_cost(section, decision);
  const Candidate& best = section.candidates[decision.candidates[decision.best].candidate];
  if (choice == decision.best || !best.feasible()) return "";
  const auto& options = decision.statistics.options;
  return fmt::format(
      "{} is {:.1f} % better than {} on average, too little to pay for: {}.",
      name_of(section, decision, decision.best),
      100.0 * (1.0 - options[decision.best].mean / options[choice].mean),
      name_of(section, decision, choice),
      section.candidates[decision.candidates[choice].candidate].path.empty()
          ? "no proposal is worth its cost"
          : fmt::format("of these {} is worth its cost", name_of(section, decision, choice)));
}

std::string chances(const EvaluateSection& section, const DecisionSection& decision) {
  const auto& options = decision.statistics.options;
  const auto pair = std::ranges::find_if(decision.statistics.pairs, [&](const auto& one) {
    return (one.first == decision.best && one.second == decision.second) ||
           (one.first == decision.second && one.second == decision.best);
  });
  if (pair == decision.statistics.pairs.end()) return "";
  const bool turned = pair->first != decision.best;
  const design::Probability better =
      turned ? design::Probability{1.0 - pair->better.value, 1.0 - pair->better.upper,
                                   1.0 - pair->better.lower}
             : pair->better;
  const double gain = (turned ? -1.0 : 1.0) * pair->mean_gain;
  std::string text = fmt::format(
      "Least mean rms with the gains held: {}, {:.4f} mdeg; it is the best of all with probability "
      "{} and better than {} with probability {}, by {:.4f} +- {:.4f} mdeg on average. Choosing it "
      "loses {:.4f} mdeg on average against whoever knew the plant.",
      name_of(section, decision, decision.best), options[decision.best].mean,
      share(options[decision.best].best), name_of(section, decision, decision.second),
      share(better), gain, pair->gain_error, options[decision.best].expected_regret);
  text += fmt::format(
      " The intervals are those of {} draws ({}); another view of what is uncertain may move the "
      "probabilities farther than that.",
      decision.draws, decision.source);
  if (section.time_domain) {
    text +=
        " Each law's factor of the nonlinear antenna comes from one record and is not drawn: of "
        "proposals that lie a few per cent apart the probability says nothing.";
  }
  const auto& outside = decision.candidates[decision.best].outside_goals;
  text += fmt::format(
      " Its hard goals hold on the {} plants it was tuned for; of the draws, which move more "
      "inputs and all at once, a share of {} breaks one.",
      section.ensemble_size, share(outside));
  return text;
}

std::string what_decides(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.sobol || decision.sobol->outputs.front().constant) return "";
  const auto& indices = decision.sobol->outputs.front();
  std::vector<std::size_t> order(indices.inputs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t i) { return indices.inputs[i].total.value; });
  std::vector<std::string> named;
  for (const std::size_t i : order) {
    if (named.size() == 3 || indices.inputs[i].total.value < 0.02) break;
    named.push_back(fmt::format("{} ({:.0f} % of the variance, with its interactions)",
                                decision.inputs[i], 100.0 * indices.inputs[i].total.value));
  }
  std::string text = fmt::format("The difference between {} and {} depends most on {}.",
                                 name_of(section, decision, decision.second),
                                 name_of(section, decision, decision.best), fmt::join(named, ", "));
  if (decision.tornado) {
    const auto turns = std::ranges::find_if(decision.tornado->bars, [&](const auto& bar) {
      return std::min(bar.at_low, bar.at_high) < 0.0;
    });
    text += turns == decision.tornado->bars.end()
                ? " No input turns it round alone within its middle 90 %."
                : fmt::format(
                      " Alone, {} turns it round: {:.4f} mdeg at its 5 % share, {:.4f} at "
                      "its 95 % share.",
                      decision.inputs[turns->input], turns->at_low, turns->at_high);
  }
  return text;
}

std::string what_to_test(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.tests) return "";
  const auto& tests = *decision.tests;
  const auto best =
      std::ranges::max_element(tests.inputs, {}, [](const auto& one) { return one.held_out_gain; });
  const double mean = tests.mean_loss[tests.choice];
  const auto& choice = name_of(section, decision, tests.choice);
  if (best == tests.inputs.end() || best->held_out_gain <= 2.0 * best->held_out_error ||
      best->held_out_gain < 1e-4 * mean) {
    return fmt::format(
        "No test of one input would change the choice of {} for the better by more than chance "
        "could feign; knowing everything would lower the expected rms by {:.4f} mdeg ({:.2f} %). "
        "What tests are worth for the tuning itself is not in this figure: gains are held here.",
        choice, std::max(0.0, tests.perfect.gain),
        100.0 * std::max(0.0, tests.perfect.gain) / mean);
  }
  const auto input = static_cast<std::size_t>(best - tests.inputs.begin());
  return fmt::format(
      "Test first: {}. Known before the choice between the proposals, it lowers the expected rms "
      "by {:.4f} to {:.4f} mdeg (held out and fitted) of the {:.4f} mdeg that knowing everything "
      "would.",
      decision.inputs[input], best->held_out_gain, best->fitted.gain, tests.perfect.gain);
}

std::optional<double> slew_stroke(const Candidate& candidate) {
  return candidate.figures ? candidate.figures->slew_stroke_margin : std::nullopt;
}

// What the antenna as it is does not reach either is no fault of a proposal, and says more of the
// case's numbers than of the drive.
std::vector<std::string> short_of_stroke(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const double as_it_is = base.path.empty() ? slew_stroke(base).value_or(1.0) : 1.0;
  const bool stated_too_high = as_it_is < 1.0;
  // Rounding lowers nothing.
  const double enough = stated_too_high ? as_it_is * (1.0 - 1e-9) : 1.0;
  std::vector<std::string> slow;
  for (const auto& candidate : section.candidates) {
    const auto stroke = slew_stroke(candidate);
    if (!stroke || *stroke >= enough) continue;
    slow.push_back(
        fmt::format("{} (stroke {:.2f} of what the slew rate takes)", candidate.name, *stroke));
  }
  std::vector<std::string> sentences;
  if (stated_too_high) {
    sentences.push_back(fmt::format(
        "The stated slew rate is out of reach of the drive as it is (stroke {:.2f} of what it "
        "takes): check drive.slew_rate, the valve and the supply.",
        as_it_is));
  }
  if (!slow.empty()) {
    sentences.push_back(fmt::format(
        "{}: {}. Pumps and valves would have to grow with them, at a cost that is not in these "
        "files.",
        stated_too_high ? "These proposals lower the stroke further"
                        : "Their valves' stroke does not reach the slew rate of today",
        fmt::join(slow, "; ")));
  }
  return sentences;
}

std::string out_of_reach(const EvaluateSection& section) {
  std::vector<std::string> infeasible, hunting;
  for (const auto& candidate : section.candidates) {
    const CandidateLaw* law = candidate.chosen_law();
    if (law == nullptr || !law->goals_met || !law->design.verification.passed) {
      infeasible.push_back(candidate.name);
    } else if (!law->still && law->time_domain) {
      hunting.push_back(
          fmt::format("{} with {} (+-{:.2f} mdeg)", candidate.name, law->structure,
                      design::hunting_amplitude(law->time_domain->hunting) / millidegree));
    }
  }
  std::vector<std::string> sentences = short_of_stroke(section);
  if (!infeasible.empty()) {
    sentences.insert(
        sentences.begin(),
        fmt::format("Not to be built as they stand: no law of {} meets every hard goal on every "
                    "plant and passes its verification; their rows show what comes closest.",
                    fmt::join(infeasible, ", ")));
  }
  if (!hunting.empty()) {
    sentences.push_back(
        fmt::format("Not chosen, whatever their rms in wind: by friction alone these hunt beyond "
                    "the tightest budget: {}.",
                    fmt::join(hunting, ", ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace

std::size_t worth_its_cost(const EvaluateSection& section, const DecisionSection& decision) {
  const auto& options = decision.statistics.options;
  const auto candidate = [&](std::size_t place) -> const Candidate& {
    return section.candidates[decision.candidates[place].candidate];
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (candidate(i).feasible()) least = std::min(least, options[i].mean);
  }
  std::size_t choice = decision.best;
  bool chosen = false;
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (!candidate(i).feasible() || !(options[i].mean <= (1.0 + negligible_change) * least)) {
      continue;
    }
    const double cost = cost_of(candidate(i)), least_cost = cost_of(candidate(choice));
    const bool cheaper = cost < least_cost;
    const bool better = cost == least_cost && options[i].mean < options[choice].mean;
    if (!chosen || cheaper || better) choice = i;
    chosen = true;
  }
  return choice;
}

std::vector<std::string> conclude(const EvaluateSection& section) {
  std::vector<std::string> sentences;
  const auto add = [&](std::string text) {
    if (!text.empty()) sentences.push_back(std::move(text));
  };
  if (section.candidates.empty()) return sentences;
  add(against_as_it_is(section));
  add(in_the_time_domain(section));
  add(plants_within_needs(section));
  add(changed_motion(section));
  add(on_the_front(section));
  add(without_cost(section));
  if (section.decision) {
    add(chances(section, *section.decision));
    add(not_worth_paying(section, *section.decision));
    add(what_decides(section, *section.decision));
    add(what_to_test(section, *section.decision));
  }
  add(out_of_reach(section));
  return sentences;
}

}  // namespace boresight::app
