#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/limit_cycle_wording.hpp>
#include <boresight/app/report/loss_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string speed(double limit) {
  if (std::isnan(limit)) return "-";
  return std::isfinite(limit) ? fmt::format("{:.1f}", limit) : "> 60";
}

std::string verdict(const Candidate& candidate) {
  if (!candidate.chosen) return "none stable";
  const auto& controller = candidate.controllers[*candidate.chosen];
  if (!controller.constraints_met) return "misses constraints";
  if (!controller.limit_cycle_free) return "LIMIT CYCLE";
  return controller.design.verification.passed ? "verified" : "NOT VERIFIED";
}

std::string cost_text(const Candidate& candidate) {
  if (!candidate.cost) return "-";
  if (candidate.cost_uncertainty > 0.0) {
    return fmt::format("{:g} +- {:g}", *candidate.cost, candidate.cost_uncertainty);
  }
  return fmt::format("{:g}", *candidate.cost);
}

void fill(std::vector<std::string>& cells, std::size_t columns) {
  cells.resize(std::max(cells.size(), columns), "-");
}

std::string simulated_text(const CandidateController& controller) {
  if (!controller.time_domain) return "-";
  const auto& wind = controller.time_domain->wind;
  const design::RunStatus status = controller.expected ? controller.expected->status : wind.status;
  if (status != design::RunStatus::complete) return std::string(design::to_string(status));
  return mdeg(controller.expected ? controller.expected->rms.value : wind.boresight_rms);
}

// "4 to 10 records of wind": what the simulated rms are of.
std::string records_text(const EvaluateSection& section) {
  std::vector<int> records;
  for (const auto& candidate : section.candidates) {
    for (const auto& controller : candidate.controllers) {
      if (controller.expected) records.push_back(controller.expected->records);
    }
  }
  if (records.empty()) return "one record of wind";
  const auto [minimum, maximum] = std::ranges::minmax(records);
  return minimum == maximum ? fmt::format("{} records of wind", maximum)
                            : fmt::format("{} to {} records of wind", minimum, maximum);
}

Document time_domain_table(const EvaluateSection& section) {
  if (!section.time_domain) return {};
  Rows rows{{"proposal", "loops", "linear mdeg", "simulated", "factor", "limit cycle at rest",
             "when tracking", "reversal error"}};
  for (const auto& candidate : section.candidates) {
    for (const auto& controller : candidate.controllers) {
      if (!controller.time_domain) continue;
      const auto& run = *controller.time_domain;
      std::vector<std::string> cells{
          candidate.name, controller.structure, mdeg(controller.design.boresight_rms),
          simulated_text(controller), fixed(controller.simulated_to_linear_rms(), 3)};
      for (const auto& limit_cycles : run.limit_cycles)
        cells.push_back(limit_cycle_cell(limit_cycles));
      if (run.reversal) {
        cells.resize(7, "-");
        cells.push_back(run.reversal->status == design::RunStatus::complete
                            ? mdeg(run.reversal->boresight_error)
                            : std::string(design::to_string(run.reversal->status)));
      }
      fill(cells, rows[0].size());
      rows.push_back(std::move(cells));
    }
  }
  return heading("Controllers on the nonlinear antenna") +
         wrapped(
             fmt::format(
                 "Every controller ran on the nonlinear antenna of its proposal, in {} of {:g} s "
                 "at {:.3g} m/s (from seed {}). Compared is the linear rms over the plants "
                 "times the factor, simulated over linear rms, with the limit cycle in "
                 "quadrature. Losses, speed limits and samples have both too.",
                 records_text(section), section.time_domain->wind_duration, section.wind_speed,
                 section.time_domain->seeds.front()),
             "  ") +
         "\n" + table(rows, "ll") +
         wrapped(limit_cycle_legend() +
                     "; reversal error: peak boresight error (mdeg) at a velocity reversal at "
                     "tracking rate.",
                 "  ");
}

// Where less than half of the hydraulic mode is oil, and which mode has most.
Document oil_modes_part(const EvaluateSection& section) {
  std::vector<std::string> modes;
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    const plant::PlantMode& maximum = candidate.oil_mode;
    if (controller == nullptr || !io::little_of_oil(controller->design.hydraulic_mode, maximum))
      continue;
    modes.push_back(fmt::format(
        "{:.3g} Hz (zeta {:.3f}) {}", maximum.frequency, maximum.damping_ratio,
        candidate.path.empty() ? candidate.name : "with " + io::in_quotes(candidate.name)));
  }
  if (modes.empty()) return {};
  return wrapped(fmt::format("Less than half of the hydraulic mode's elastic energy is in the oil; "
                             "the dominant hydraulic mode is at {}.",
                             fmt::join(modes, ", ")),
                 "  ");
}

Document loop_table(const EvaluateSection& section) {
  const bool simulated = section.time_domain.has_value();
  Rows rows{{"proposal", "loops", "cost", "J kg.m2", "ratio", "hydr. Hz", "zeta", "linear mdeg"}};
  if (simulated) rows[0].insert(rows[0].end(), {"simulated", "factor"});
  rows[0].insert(rows[0].end(), {"over plants", "worst", "worst plant", "check"});
  for (const auto& candidate : section.candidates) {
    std::vector<std::string> cells{candidate.name, "-", cost_text(candidate),
                                   fixed(candidate.reflected_inertia, 3),
                                   fixed(candidate.motor_to_load_ratio, 2)};
    if (candidate.chosen) {
      const auto& controller = candidate.controllers[*candidate.chosen];
      cells[1] = controller.structure;
      cells.push_back(fixed(controller.design.hydraulic_mode.frequency, 3));
      cells.push_back(fixed(controller.design.hydraulic_mode.damping_ratio, 3));
      const double factor = controller.simulated_to_linear_rms();
      cells.push_back(mdeg(controller.design.boresight_rms));
      if (simulated) {
        cells.push_back(simulated_text(controller));
        cells.push_back(fixed(factor, 3));
      }
      cells.push_back(mdeg(controller.compared_rms()));
      if (controller.ensemble) {
        const bool all =
            controller.ensemble->stable == static_cast<int>(controller.ensemble->members.size());
        cells.push_back(all ? mdeg(controller.effect().rms(controller.ensemble->largest_rms))
                            : "unstable");
        cells.push_back(controller.ensemble->members[controller.ensemble->worst].name);
      }
    }
    fill(cells, rows[0].size() - 1);
    cells.push_back(verdict(candidate));
    rows.push_back(std::move(cells));
  }
  return essential(table(rows, "ll")) +
         wrapped(
             fmt::format(
                 "cost{}; linear: rms on the nominal plant by the spectrum; {}over plants: root "
                 "mean square over the {} ensemble members{}, worst: the largest of them; worst "
                 "plant: the one farthest beyond its constraints. hydr., zeta: frequency and "
                 "damping of the open-loop hydraulic mode.",
                 section.currency.empty() ? ": stated by no proposal" : " in " + section.currency,
                 simulated ? fmt::format("simulated: in {} on the nonlinear antenna; factor: that "
                                         "over the linear rms; ",
                                         records_text(section))
                           : std::string(),
                 section.ensemble_size,
                 simulated ? ", of linear loops, times the factor, with the limit cycle" : ""),
             "  ") +
         oil_modes_part(section);
}

// "24/30": plants on which the candidate's controller meets a budget where it is needed.
std::string plants_text(const EvaluateSection& section, const Candidate& candidate,
                        std::size_t budget) {
  const CandidateController* controller = candidate.chosen_controller();
  if (controller == nullptr || budget >= controller->budgets_met.size()) return "-";
  const auto& met = controller->budgets_met[budget];
  return met ? fmt::format("{}/{}", *met, section.ensemble_size) : "-";
}

Document service_table(const EvaluateSection& section) {
  Rows rows{{"proposal"}};
  for (const auto& band : section.bands) rows[0].push_back(fmt::format("dB {}", band.name));
  if (section.climate) {
    for (const auto& band : section.bands) {
      rows[0].push_back(fmt::format("climate dB {}", band.name));
    }
  }
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    rows[0].push_back(fmt::format("({}) m/s", i + 1));
    if (section.budgets[i].wind_speed) rows[0].push_back(fmt::format("({}) plants", i + 1));
  }
  const bool stroke_stated =
      std::ranges::any_of(section.candidates, [](const Candidate& candidate) {
        return candidate.figures && candidate.figures->slew_rate_margin;
      });
  for (const char* name :
       {"torque margin", stroke_stated ? "stroke, gusts" : "assumed stroke, gusts", "slew margin",
        "slew deg/s", "10 deg s", "accel. deg/s2"}) {
    rows[0].emplace_back(name);
  }
  if (section.time_domain) rows[0].emplace_back("reversal mdeg");
  for (const auto& candidate : section.candidates) {
    std::vector<std::string> cells{candidate.name};
    if (candidate.figures) {
      const auto& figures = *candidate.figures;
      for (const double loss : figures.losses) cells.push_back(loss_text(loss));
      for (const double loss : figures.climate_losses) cells.push_back(loss_text(loss));
      for (std::size_t i = 0; i < figures.speed_limits.size(); ++i) {
        cells.push_back(speed(figures.speed_limits[i]));
        if (section.budgets[i].wind_speed) cells.push_back(plants_text(section, candidate, i));
      }
      cells.push_back(fixed(figures.supply_margin, 2));
      cells.push_back(fixed(figures.demand_margin, 1));
      cells.push_back(figures.slew_rate_margin ? fixed(*figures.slew_rate_margin, 2) : "-");
      if (figures.slew) {
        cells.push_back(fixed(figures.slew->rate / degree, 3));
        cells.push_back(figures.slew->time ? fixed(*figures.slew->time, 1) : "never");
        cells.push_back(fixed(figures.slew->reachable_acceleration / degree, 3));
      }
      fill(cells, rows[0].size() - (section.time_domain ? 1 : 0));
      if (const auto error = candidate.reversal_error()) cells.push_back(mdeg(*error));
    }
    fill(cells, rows[0].size());
    rows.push_back(std::move(cells));
  }
  Document text = table(rows, "l");
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const auto& budget = section.budgets[i];
    text += fmt::format(
        "  ({}) {}, band {}, {}: {} mdeg, met up to that mean wind speed{}\n", i + 1, budget.name,
        budget.band, budget.convention, mdeg(budget.rms),
        budget.wind_speed
            ? fmt::format("; plants: met on so many at the required {:.3g} m/s{}",
                          *budget.wind_speed, dish_and_mast(section.wind_mast, *budget.wind_speed))
            : "");
  }
  const auto beyond = [](double loss) { return loss > largest_parabola_loss; };
  const bool far_out = std::ranges::any_of(section.candidates, [&](const Candidate& candidate) {
    return candidate.figures && (std::ranges::any_of(candidate.figures->losses, beyond) ||
                                 std::ranges::any_of(candidate.figures->climate_losses, beyond));
  });
  return text + (far_out ? wrapped(beyond_the_parabola(), "  ") : Document()) +
         wrapped(
             "dB: mean loss over two equal axes on the nominal plant; m/s: wind speeds at the dish "
             "centre; both with the factor above where there is one. torque margin: supply torque "
             "beyond friction and offset, over mean wind torque and gust crest; stroke, gusts: "
             "valve stroke over the demand in the same; slew margin: highest rate against friction "
             "and offset with the valve fully open, over the slew rate. slew: rate and time of a "
             "10 deg move with reserve, at 0.2 deg/s2 at most; accel.: half of what the torque "
             "beyond friction gives at that rate. reversal: peak boresight error at a velocity "
             "reversal at tracking rate.",
             "  ") +
         (stroke_stated ? Document()
                        : wrapped("The case states no valve stroke (drive.valve_rated_flow or "
                                  "[simulation]): that for its slew rate is assumed.",
                                  "  "));
}

Document changes_part(const EvaluateSection& section) {
  Document text;
  for (const auto& candidate : section.candidates) {
    if (candidate.path.empty()) continue;
    text += "\n" + wrapped(fmt::format("{} ({}): {}", candidate.name, candidate.path,
                                       candidate.description),
                           "  ", "  ");
    if (!candidate.changes.empty() || !candidate.derived_quantities.empty()) {
      Rows rows{{"changes", "from", "to", "because"}};
      for (const auto& change : candidate.changes) {
        rows.push_back(
            {change.key, change.before, change.after,
             change.basis == io::Basis::assumed ? "assumed: " + change.source : change.source});
      }
      for (const auto& one : candidate.derived_quantities) {
        const std::string unit = one.unit == "1" ? "" : " " + one.unit;
        const std::string before = fmt::format("{:.5g}{}", one.before, unit);
        const std::string after = fmt::format("{:.5g}{}", one.after, unit);
        // Equal to the digits printed.
        if (before == after) continue;
        rows.push_back({"  " + one.quantity, before, after, "follows from " + one.follows_from});
      }
      if (rows.size() > 1) text += table(rows, "llll");
    }
    for (const auto& risk : candidate.risks) text += wrapped("Risk: " + risk, "  ", "  ");
  }
  return text;
}

Document controllers_part(const EvaluateSection& section) {
  Rows rows{{"proposal", "loops", "rms mdeg", "linear over plants", "constraints met", "S rate",
             "S valve", "S pos.", "effort rad/s", "starts", "gains"}};
  for (const auto& candidate : section.candidates) {
    for (std::size_t i = 0; i < candidate.controllers.size(); ++i) {
      const CandidateController& controller = candidate.controllers[i];
      std::vector<std::string> cells{candidate.name, controller.structure};
      if (controller.stable() && controller.ensemble) {
        cells.push_back(mdeg(controller.design.boresight_rms));
        cells.push_back(mdeg(controller.member_rms));
        cells.push_back(fmt::format("{}/{}", controller.ensemble->within_constraints,
                                    controller.ensemble->members.size()));
        const auto& loops = controller.design.tuning.controller;
        for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
          cells.push_back(control::has_break(loops, control::loop_breaks[b])
                              ? fixed(controller.design.verification.peaks[b].upper, 3)
                              : "-");
        }
        cells.push_back(fixed(controller.design.control_effort, 3));
        cells.push_back(loops.structure.state_space() != nullptr
                            ? "-"
                            : fmt::format("{}/{}", controller.design.tuning.starts_at_optimum,
                                          controller.design.tuning.starts));
        const auto& gains = controller.design.tuning.controller.structure.gains();
        const auto& written = candidate.gains.at(i);
        std::string list;
        if (loops.structure.state_space() != nullptr) list = loops.structure.name();
        for (std::size_t k = 0; k < written.size(); ++k) {
          list += fmt::format("{}{} {}", k == 0 ? "" : ", ", gains[k].symbol, written[k]);
        }
        cells.push_back(std::move(list));
      }
      fill(cells, rows[0].size());
      rows.push_back(std::move(cells));
    }
  }
  return table(rows, "llrrrrrrrrl") +
         wrapped(
             "S: maximum sensitivity Ms with the loop cut at rate loop alone, valve command, "
             "position loop, on the nominal plant; starts: searches that ended within 1 % of the "
             "best.",
             "  ");
}

}  // namespace

std::string heading_of(const EvaluateSection& section) {
  return fmt::format("Proposals, re-tuned: wind model {}, {:.3g} m/s",
                     plant::to_string(section.wind_model), section.wind_speed);
}

Document document_of(const EvaluateSection& section) {
  Document text = heading(heading_of(section));
  text += wrapped(
      fmt::format("Each proposal is re-tuned so that every constraint holds on the nominal plant "
                  "and each of {} plants, {}, the same samples for all. {}",
                  section.ensemble_size, section.ensemble_source,
                  section.minimises_climate ? "Objective: rms over the wind climate."
                  : section.climate         ? "Objective: rms at the design wind speed."
                                    : "The case states no wind climate: losses are at one speed."),
      "  ");
  if (!section.not_run.empty()) {
    text += wrapped(fmt::format("Not run: {}.", fmt::join(section.not_run, "; ")), "  ");
  }
  text += "\n" + loop_table(section) + "\n" + service_table(section);
  std::vector<std::string> names;
  for (const std::size_t i : section.front) {
    const auto& candidate = section.candidates[i];
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || !candidate.cost) continue;
    names.push_back(fmt::format("{} ({:g}, {} mdeg)", candidate.name, *candidate.cost,
                                mdeg(controller->compared_rms())));
  }
  if (!section.currency.empty()) {
    text += essential(
        "\n" + wrapped(fmt::format("Pareto front of cost ({}) and rms over the plants: {}.",
                                   section.currency,
                                   names.empty() ? "none, as none is eligible"
                                                 : fmt::format("{}", fmt::join(names, "; "))),
                       "  "));
  }
  text += time_domain_table(section);
  if (section.decision) text += document_of(section, *section.decision);
  text += heading("Changes of each proposal and their consequences") + changes_part(section);
  return text + heading("Loops of each proposal") + controllers_part(section);
}

}  // namespace boresight::app
