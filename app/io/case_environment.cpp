#include <set>

#include <boresight/app/io/case_sections.hpp>
#include <boresight/app/io/wording.hpp>

namespace boresight::app {

void read_pointing(TableReader& file, Case& antenna) {
  TableReader table = file.table("pointing");
  std::set<std::string> names;
  for (auto& entry : table.tables("band", true)) {
    BandEntry band;
    band.name = read_name(entry, names);
    band.frequency = entry.quantity("frequency", Kind::frequency, Range::between(1e8, 1e13));
    band.beamwidth_factor =
        entry.quantity("beamwidth_factor", Kind::angle, Range::between(0.5, 2.0));
    entry.finish();
    antenna.bands.push_back(std::move(band));
  }
  for (auto& entry : table.tables("budget", true)) {
    BudgetEntry budget;
    budget.name = entry.text("name");
    budget.band = entry.choice("band", {names.begin(), names.end()});
    budget.loss = entry.optional_quantity("loss", Kind::level, Range::positive(3.0));
    budget.rms = entry.optional_quantity("rms", Kind::angle, Range::positive(1.0));
    if (budget.loss && budget.rms) {
      entry.refuse("rms", "expected either loss (dB) or rms (angle), found both");
    }
    // Beside a misspelt loss it is no unknown key: the misspelt one is what to name.
    if (budget.loss || (!budget.rms && entry.has("convention"))) {
      budget.convention = entry.choice(
          "convention", {"mean_loss_two_axes", "mean_loss_one_axis", "loss_at_mean_radial_error"});
    }
    entry.finish();
    if (!budget.loss && !budget.rms) {
      entry.refuse("loss", "expected either loss (dB) or rms (angle), found neither");
    }
    antenna.budgets.push_back(std::move(budget));
  }
  table.finish();
}

void read_goals(TableReader& file, Case& antenna) {
  TableReader table = file.table("goals");
  GoalsEntry& goals = antenna.goals;
  goals.sensitivity_peak =
      table.quantity("sensitivity_peak", Kind::number, Range::between(1.01, 100.0));
  goals.valve_effort = table.quantity("valve_effort", Kind::angular_rate, Range::positive());
  goals.lowest_frequency =
      table.quantity("lowest_frequency", Kind::frequency, Range::between(1e-6, 1.0));
  goals.highest_frequency =
      table.quantity("highest_frequency", Kind::frequency, Range::between(1.0, 1e4));
  table.finish();
  if (goals.highest_frequency.value <= goals.lowest_frequency.value) {
    table.refuse("highest_frequency", "expected a frequency above lowest_frequency, found " +
                                          quoted(goals.highest_frequency.text));
  }

  TableReader matching = file.table("matching");
  const long most = matching.integer("most_disks", 1, 10000);
  const long step = matching.integer("step", 1, most);
  for (long disks = 0; disks <= most; disks += step) {
    antenna.matching_disks.push_back(static_cast<double>(disks));
  }
  matching.finish();
}

}  // namespace boresight::app
