#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/climate_wording.hpp>
#include <boresight/app/report/loss_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/io/case/drive_numbers.hpp>
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

std::string decibel(double factor) {
  return std::isfinite(factor) && factor > 0.0 ? fmt::format("{:.1f}", 20.0 * std::log10(factor))
                                               : "none";
}

// With a climate also the fraction of its time up to that speed or, if less, the supply's.
std::string speed(const TuneSection& section, double limit) {
  if (std::isnan(limit)) return "-";
  std::string text = std::isfinite(limit) ? fmt::format("{:.2f}", limit) : "> 60";
  if (section.climate.empty()) return text;
  return fmt::format(
      "{} ({})", text,
      percent_of_time(section.climate, std::min(limit, section.torque_limited_wind_speed)));
}

double loss(double rms, const design::PointingBand& band) {
  return design::pointing_loss_db(rms, band.beamwidth, design::LossConvention::mean_loss_two_axes);
}

// Whether a table of the controllers' losses has one beyond the beam's parabola.
bool far_out(const TuneSection& section) {
  return std::ranges::any_of(section.controllers, [&](const TunedController& row) {
    const double rms = std::max(row.boresight_rms, row.climate_rms.value_or(0.0));
    return std::ranges::any_of(section.bands, [&](const design::PointingBand& band) {
      return loss(rms, band) > largest_parabola_loss;
    });
  });
}

std::string verdict(const TunedController& row) {
  if (!row.stable()) return row.tuned_for == TunedFor::present ? "UNSTABLE" : "none stable";
  if (!row.constraints_met)
    return row.design.tuning.interrupted ? "not finished" : "misses constraints";
  if (row.in_time && !row.in_time->limit_cycle_free) return "LIMIT CYCLE";
  return row.design.verification.passed ? "verified" : "NOT VERIFIED";
}

std::vector<std::string> first_cells(const TunedController& row) {
  return {row.structure, std::string(to_string(row.tuned_for)),
          fmt::format("{:.3g}", row.wind_speed)};
}

// What the static error in the mean wind would add to the losses.
Document static_error_part(const TuneSection& section) {
  const TunedController* recommended = recommended_tuned_controller(section);
  if (section.bands.empty() || section.wind_speeds.empty() || recommended == nullptr) return {};
  design::TrackingProblem problem = section.problem;
  problem.wind.mean_speed = section.wind_speeds.front();
  const double error =
      design::static_boresight_error(problem, recommended->design.tuning.controller);
  std::vector<std::string> losses;
  for (const auto& band : section.bands) {
    losses.push_back(
        fmt::format("{} dB in band {}",
                    loss_text(design::pointing_loss_db(error, band.beamwidth,
                                                       design::LossConvention::mean_loss_one_axis)),
                    band.name));
  }
  return wrapped(
      fmt::format("Losses exclude the static error in the mean wind of {:.3g} m/s, structural "
                  "flexure included: {} mdeg with {}. Remove it by a boresight scan; it would add "
                  "{}.",
                  problem.wind.mean_speed, mdeg(error), recommended->structure,
                  fmt::join(losses, ", ")),
      "  ");
}

// Controllers "verified" without a run on the nonlinear antenna where others ran there.
Document linear_alone_part(const TuneSection& section) {
  const auto some_ran = [&](const auto& counts) {
    return std::ranges::any_of(section.controllers, [&](const TunedController& row) {
      return row.in_time && counts(row);
    });
  };
  std::vector<std::string> names;
  for (const auto& row : section.controllers) {
    if (row.in_time || !row.usable()) continue;
    std::string name = row.tuned_for == TunedFor::present
                           ? std::string("present gains")
                           : fmt::format("{} controllers", to_string(row.tuned_for));
    if (some_ran([&](const TunedController& other) { return other.tuned_for == row.tuned_for; })) {
      name += fmt::format(" at {:.3g} m/s", row.wind_speed);
    }
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  if (names.empty() || !some_ran([](const TunedController&) { return true; })) return {};
  return wrapped(fmt::format("Not run on the nonlinear antenna: {}. They are verified on the "
                             "linear plant only, and may limit-cycle.{}",
                             fmt::join(names, ", "),
                             section.budgets.empty()
                                 ? ""
                                 : " Speeds up to which a budget is met are of the linear plant "
                                   "for these, by simulation with the limit cycle for the others."),
                 "  ");
}

Document pointing_part(const TuneSection& section) {
  const bool climate = std::ranges::any_of(
      section.controllers, [](const TunedController& row) { return row.climate_rms.has_value(); });
  Rows rows{{"structure", "tuned for", "m/s", "rms mdeg", "worst plant"}};
  for (const auto& band : section.bands) rows[0].push_back(fmt::format("dB {}", band.name));
  if (climate) {
    rows[0].emplace_back("climate mdeg");
    for (const auto& band : section.bands) {
      rows[0].push_back(fmt::format("climate dB {}", band.name));
    }
  }
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    rows[0].push_back(fmt::format("({}) m/s", i + 1));
  }
  rows[0].emplace_back("check");
  for (const auto& row : section.controllers) {
    auto cells = first_cells(row);
    cells.push_back(mdeg(row.boresight_rms));
    const bool all_stable =
        row.ensemble && row.ensemble->stable == static_cast<int>(row.ensemble->members.size());
    cells.push_back(!row.ensemble ? "-"
                    : all_stable  ? mdeg(row.ensemble->largest_rms)
                                  : "unstable");
    for (const auto& band : section.bands)
      cells.push_back(loss_text(loss(row.boresight_rms, band)));
    if (climate) {
      const double rms = row.climate_rms.value_or(std::nan(""));
      cells.push_back(mdeg(rms));
      for (const auto& band : section.bands) cells.push_back(loss_text(loss(rms, band)));
    }
    for (const double limit : row.speed_limits) cells.push_back(speed(section, limit));
    cells.push_back(verdict(row));
    rows.push_back(std::move(cells));
  }
  Document text = essential(table(rows, "ll"));
  if (section.wind_mast) text += wrapped(mast_in_words(*section.wind_mast), "  ");
  text += essential(linear_alone_part(section));
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const auto& budget = section.budgets[i];
    text += essential(verbatim(fmt::format(
        "  ({}) {}, band {}, {}: {} mdeg, met up to that mean wind speed{}\n", i + 1, budget.name,
        budget.band, budget.convention, mdeg(budget.rms),
        budget.wind_speed ? fmt::format("; {:.3g} m/s{} required", *budget.wind_speed,
                                        dish_and_mast(section.wind_mast, *budget.wind_speed))
                          : "")));
  }
  if (!section.budgets.empty() && std::isfinite(section.torque_limited_wind_speed)) {
    text += wrapped(fmt::format("Supply torque ignored: at {:.1f} m/s the mean wind takes all of "
                                "it that friction and offset leave.",
                                section.torque_limited_wind_speed),
                    "  ");
  }
  if (!section.budgets.empty() && !section.climate.empty()) {
    text +=
        wrapped(fmt::format("In brackets: fraction of the climate's time up to that speed, or up "
                            "to the supply's if lower; the climate's highest speed is {:.4g} m/s.",
                            design::highest_speed(section.climate)),
                "  ");
  }
  for (const auto& band : section.bands) {
    text +=
        fmt::format("  dB {}: mean loss over two equal axes, beamwidth {:.3f} mdeg at {:g} GHz{}\n",
                    band.name, band.beamwidth / millidegree, band.frequency / 1e9,
                    band.illumination.empty() ? "" : ", " + band.illumination);
  }
  if (far_out(section)) text += wrapped(beyond_the_parabola(), "  ");
  return text + static_error_part(section);
}

Document robustness_part(const TuneSection& section) {
  constexpr std::size_t valve = 1, position = 2;
  Rows rows{{"structure", "tuned for", "m/s", "S rate", "S valve", "S pos.", "PM valve", "GM valve",
             "PM pos.", "GM pos.", "effort rad/s", "stable plants", "constraints met",
             "active constraints"}};
  for (const auto& row : section.controllers) {
    auto cells = first_cells(row);
    if (!row.stable()) {
      cells.insert(cells.end(), 11, "-");
      rows.push_back(std::move(cells));
      continue;
    }
    const auto& design = row.design;
    const auto has = [&](std::size_t loop) {
      return control::has_break(design.tuning.controller, control::loop_breaks.at(loop));
    };
    for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
      cells.push_back(has(b) ? fixed(design.verification.peaks[b].upper, 3) : "-");
    }
    for (const std::size_t loop : {valve, position}) {
      cells.push_back(has(loop) ? fixed(design.margins.at(loop).phase_margin_deg, 1) : "-");
      cells.push_back(has(loop) ? decibel(design.margins.at(loop).increasing_gain_margin) : "-");
    }
    cells.push_back(fixed(design.control_effort, 3));
    const auto of_all = [&](int count) {
      return row.ensemble ? fmt::format("{}/{}", count, row.ensemble->members.size()) : "-";
    };
    cells.push_back(of_all(row.ensemble ? row.ensemble->stable : 0));
    cells.push_back(of_all(row.ensemble ? row.ensemble->within_constraints : 0));
    cells.push_back(fmt::format("{}", design.tuning.limits.size()));
    rows.push_back(std::move(cells));
  }
  return table(rows, "ll") +
         wrapped(
             "S: maximum sensitivity Ms with the loop cut at rate loop alone, valve command, "
             "position loop; PM, GM: phase margin in degrees, gain margin in dB.",
             "  ");
}

// One table a structure and wind speed: present gains, where there are any, and tuned ones.
Document gains_part(const TuneSection& section) {
  const TunedController* recommended = recommended_tuned_controller(section);
  Document text;
  for (std::size_t i = 0; i < section.controllers.size(); ++i) {
    const auto same = [&](const TunedController& row) {
      return row.structure == section.controllers[i].structure &&
             row.wind_speed == section.controllers[i].wind_speed;
    };
    const auto before = section.controllers.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(section.controllers.begin(), before, same)) continue;
    const auto& descriptions = section.controllers[i].design.tuning.controller.structure.gains();
    Rows rows{{"gain", "searched, SI"}};
    for (const auto& gain : descriptions) {
      rows.push_back({fmt::format("{} {}", gain.symbol, gain.name),
                      fmt::format("{:g} .. {:g} {}", gain.lower, gain.upper,
                                  gain.unit == "1" ? "" : gain.unit)});
    }
    for (const auto& row : section.controllers) {
      if (!same(row)) continue;
      rows[0].emplace_back(to_string(row.tuned_for));
      const auto texts = section.gains_of(row);
      for (std::size_t k = 0; k < descriptions.size(); ++k) {
        rows[k + 1].push_back(k < texts.size() ? texts[k] : "-");
      }
    }
    const auto& structure = section.controllers[i].design.tuning.controller.structure;
    Document part =
        subheading(fmt::format("{} at {:.3g} m/s", section.controllers[i].structure,
                               section.controllers[i].wind_speed)) +
        (section.controllers[i].is_state_space() ? wrapped(state_space_text(structure) + ".", "  ")
                                                 : table(rows, "ll"));
    const bool best = recommended != nullptr && same(*recommended);
    text += best ? essential(std::move(part)) : std::move(part);
  }
  return text;
}

Document limits_part(const TuneSection& section) {
  Document text;
  for (const auto& row : section.controllers) {
    const auto& tuning = row.design.tuning;
    if (row.tuned_for == TunedFor::present || !row.stable() || row.is_state_space()) continue;
    std::vector<std::string> limits;
    for (const auto& limit : tuning.limits) limits.push_back(limit.description());
    if (limits.empty()) limits = tuning.active_constraints;
    if (limits.empty()) limits.emplace_back("none");
    const auto& check = row.design.verification;
    if (row.constraints_met && !check.passed) {
      limits.push_back(fmt::format("NOT VERIFIED: {}", check.failure));
    }
    text += wrapped(fmt::format("{}, {}, {:.3g} m/s: {}.", row.structure, to_string(row.tuned_for),
                                row.wind_speed, fmt::join(limits, "; ")),
                    "  ", "  ");
  }
  std::vector<const TunedController*> controllers;
  for (const auto& row : section.controllers) controllers.push_back(&row);
  const double sample_time = control::sample_time_of(section.problem.delay);
  for (const auto& sentence : gains_at_bounds(controllers, sample_time)) {
    text += wrapped(sentence, "  ", "  ");
  }
  for (const auto& sentence : gain_trades(controllers, section.gain_units))
    text += wrapped(sentence, "  ", "  ");
  return text;
}

Document goals_part(const TuneSection& section) {
  const design::Constraints& goals = section.goals;
  const auto& peaks = goals.sensitivity_peak;
  std::string text = fmt::format(
      "Constraints: Ms at most {:g} (rate loop alone), {:g} (valve command), {:g} (position loop); "
      "control effort at most {:g} rad/s",
      peaks[0], peaks[1], peaks[2], goals.control_effort);
  const auto& gain_margin = goals.gain_margin[0];
  const auto& phase_margin = goals.phase_margin[0];
  if (gain_margin) text += fmt::format("; gain margin {} dB", decibel(*gain_margin));
  if (phase_margin) {
    text += fmt::format("; phase margin {:.4g} deg", *phase_margin * 180.0 / std::numbers::pi);
  }
  if (goals.bandwidth) {
    text += fmt::format("; bandwidth {:.4g} Hz", *goals.bandwidth / two_pi);
  }
  if (goals.static_encoder_error) {
    text += fmt::format("; encoder error by leakage in the mean wind at most {:.4g} mdeg",
                        *goals.static_encoder_error / millidegree);
  }
  if (goals.standstill) {
    text += fmt::format(
        "; Ms at most {:g} at standstill (valve command, viscous friction {:.3g} N.m.s/rad)",
        goals.standstill->sensitivity_peak, fmt::join(goals.standstill->friction, ", "));
  }
  if (goals.gust_torque && goals.gust_demand) {
    text += fmt::format("; {:g} times rms in gusts within {:.4g} N.m and {:.4g} rad/s",
                        goals.crest_factor, *goals.gust_torque, *goals.gust_demand);
  }
  if (section.boresight_rms_goal)
    text += fmt::format("; rms {} mdeg", mdeg(*section.boresight_rms_goal));
  return wrapped(
      fmt::format("{}. Objective: {} rms{}. Robust controllers meet the constraints on {} plants, "
                  "{}. {} starts.",
                  text, design::to_string(section.objective.kind),
                  section.minimises_climate ? " over the site's wind climate" : "",
                  section.ensemble_size, to_string(section.ensemble_source), section.starts),
      "  ");
}

}  // namespace

Document document_of(const TuneSection& section) {
  Document text =
      heading(fmt::format("Tuned loops: {}, wind model {}", fmt::join(section.structures, ", "),
                          plant::to_string(section.wind_model)));
  text += goals_part(section) + "\n";
  if (!section.not_run.empty()) {
    text += wrapped(fmt::format("Not run: {}.", fmt::join(section.not_run_texts(), "; ")), "  ");
  }
  text += pointing_part(section) + "\n" + robustness_part(section);
  const bool before = std::ranges::any_of(section.controllers, [](const TunedController& row) {
    return row.tuned_for == TunedFor::present;
  });
  text += heading(before ? "Gains, before and after" : "Gains") + gains_part(section);
  text += heading("Active constraints and their shadow prices");
  return text + limits_part(section);
}

}  // namespace boresight::app
