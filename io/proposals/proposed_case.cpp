#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/proposals/changeable_numbers.hpp>
#include <boresight/io/proposals/dependent_changes.hpp>
#include <boresight/io/proposals/proposed_case.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

std::string after_text(const ProposedChange& change) {
  return change.multiplies ? "x " + change.number.text : change.number.text;
}

class Application {
 public:
  Application(const Case& antenna, const Proposal& proposal)
      : before_(antenna), proposal_(proposal), result_{antenna, {}, {}}, after_(result_.antenna) {}

  ProposedCase run() {
    check_structures();
    apply_lines();
    apply_gear();
    apply_numbers();
    apply_modes();
    apply_gear_spring();
    apply_motor();
    if (const auto* rate = proposal_.find("controller.sample_rate")) {
      note_before(rate->key,
                  fmt::format("{:.4g} Hz by the delay",
                              1.0 / control::sample_time_of(before_.controller->delay.value)));
    }
    follow_sampling(before_, proposal_, after_);
    follow_drive(before_, proposal_, after_);
    check_friction();
    for (const auto& change : proposal_.changes) add_row(change);
    check_any_change();
    result_.derived_quantities = derived_quantities_of(before_, after_);
    std::erase_if(result_.derived_quantities, [&](const DerivedChange& one) {
      const auto* named = proposal_.find(one.key);
      // Nothing else moves a locked-rotor frequency that the proposal names.
      return named != nullptr &&
             (!named->multiplies || one.key == "structure.locked_rotor_frequency");
    });
    return std::move(result_);
  }

 private:
  void check_structures() const {
    for (const auto& name : proposal_.structures) {
      try {
        check_structure(before_, name);
      } catch (const InvalidInput& error) {
        refuse_at(
            proposal_.structures_location, "structures",
            fmt::format("expected loop structures, found {}: {}", in_quotes(name), error.what()));
      }
    }
  }

  // Lengths first: volumes that the file states are held against them.
  void apply_lines() {
    const auto* modulus = proposal_.find("oil.bulk_modulus");
    const auto* lengths = proposal_.find("oil.line_lengths");
    if (modulus != nullptr || lengths != nullptr) {
      // A case may have the modulus from its lines' pressure waves: it is the oil's, not the
      // lines'.
      Quantity mean;
      mean.value = bulk_modulus(before_);
      mean.kind = Kind::pressure;
      mean.text = fmt::format("{:.6g} Pa", mean.value);
      mean.key = "oil.bulk_modulus";
      Quantity own = after_.oil->bulk_modulus.value_or(mean);
      if (modulus != nullptr) {
        note_before("oil.bulk_modulus", own.text);
        own = changed(*modulus, own);
        check_changed_range(*modulus, Kind::pressure, Range::between(1e7, 1e10), own.value);
      }
      after_.oil->bulk_modulus = own;
    }
    if (lengths == nullptr) return;
    const double factor = lengths->number.value;
    for (auto& line : after_.oil->lines) {
      line.length.value *= factor;
      line.slosh_frequency.value /= factor;
    }
    for (auto& line : after_.campaign->lines) line.length.value *= factor;
    const auto* fraction = proposal_.find("oil.line_share");
    const bool stated =
        proposal_.find("oil.volume_1") != nullptr || proposal_.find("oil.volume_2") != nullptr;
    if (fraction != nullptr && stated) {
      refuse_change(*fraction,
                    "expected either line_share, from which the volumes follow, or volume_1 and "
                    "volume_2, found both");
    }
    if (fraction != nullptr) {
      const double kept = 1.0 - fraction->number.value + fraction->number.value * factor;
      if (!(kept > 0.0)) {
        refuse_change(*fraction, "expected volumes to be left when the lines are gone, found none");
      }
      for (Quantity* volume : {&after_.oil->volume_1, &after_.oil->volume_2}) volume->value *= kept;
    } else if (!stated) {
      refuse_change(
          *lengths,
          "expected line_share (the fraction of each volume that is lines) or the volumes "
          "beside it, found neither: volumes must follow the lines");
    } else {
      for (const char* key : {"oil.volume_1", "oil.volume_2"}) {
        if (proposal_.find(key) == nullptr) {
          refuse_change(*lengths, fmt::format("expected both volumes beside it, found no {}", key));
        }
      }
    }
  }

  void check_volume(const ProposedChange& change, double before, double after) const {
    const auto* lengths = proposal_.find("oil.line_lengths");
    if (lengths == nullptr) return;
    const double factor = lengths->number.value;
    const double minimum = std::min(1.0, factor) * before, maximum = std::max(1.0, factor) * before;
    constexpr double rounding = 1e-3;
    if (after < minimum * (1.0 - rounding) || after > maximum * (1.0 + rounding)) {
      refuse_change(
          change,
          fmt::format("expected {:.4g} to {:.4g} m3, all that lines of {:g} times the length can "
                      "make of {:.4g} m3, found {:.4g} m3: oil.line_lengths contradicts it",
                      minimum, maximum, factor, before, after));
    }
  }

  void apply_gear() {
    auto& train = *after_.gear_train;
    for (const auto& change : proposal_.changes) {
      if (change.key.starts_with("gear_train.stage[")) {
        const auto number = static_cast<std::size_t>(std::stoul(change.key.substr(17)));
        if (number > train.stages.size()) {
          refuse_change(change, fmt::format("expected a stage from 1 to {}, the case's, found {}",
                                            train.stages.size(), number));
        }
        GearStageEntry& stage = train.stages[number - 1];
        Quantity& teeth =
            change.key.ends_with("driven_teeth") ? stage.driven_teeth : stage.driving_teeth;
        note_before(change.key, teeth.text);
        teeth = changed(change, teeth);
        if (std::abs(teeth.value - std::round(teeth.value)) > 1e-9) {
          refuse_change(change,
                        fmt::format("expected a whole number of teeth, found {:g}", teeth.value));
        }
      } else if (change.key.starts_with("gear_train.assembly[")) {
        change_assembly(change);
      }
    }
  }

  void change_assembly(const ProposedChange& change) {
    const std::string name =
        change.key.substr(20, change.key.size() - 20 - std::string_view("].inertia").size());
    auto& assemblies = after_.gear_train->assemblies;
    const auto found = std::ranges::find(assemblies, name, &RotatingAssembly::name);
    if (found == assemblies.end()) {
      std::vector<std::string_view> known;
      for (const auto& assembly : assemblies) known.emplace_back(assembly.name);
      refuse_change(change,
                    fmt::format("expected an assembly of the case ({}), found {}{}",
                                quoted_list(known), in_quotes(name), did_you_mean(name, known)));
    }
    if (!found->inertia && change.multiplies) {
      refuse_change(change,
                    "expected an inertia, since the case sums this one from its parts, found a "
                    "factor");
    }
    std::optional<Quantity>& inertia = found->inertia;
    note_before(change.key, inertia ? inertia->text : "of its parts");
    inertia = changed(change, inertia ? *inertia : change.number);
  }

  void apply_numbers() {
    for (const auto& number : changeable_numbers()) {
      const auto* change = proposal_.find(number.path());
      if (change == nullptr) continue;
      Quantity* quantity = number.in(after_);
      const Quantity* own = number.in(original_);
      if (quantity == nullptr || own == nullptr) {
        refuse_change(*change,
                      fmt::format("expected a number that the case has, found none of it in {}{}",
                                  before_.path, remedy(*change)));
      }
      note_before(change->key, own->text);
      *quantity = changed(*change, *quantity);
      check_changed_range(*change, number.kind, number.range, quantity->value);
      if (number.kind == Kind::volume) check_volume(*change, own->value, quantity->value);
    }
  }

  // For a number that the case has not.
  std::string_view remedy(const ProposedChange& change) const {
    if (change.key != "drive.valve_rated_flow") return "";
    return before_.simulation ? ": change simulation.valve_stroke instead"
                              : ": state it there, with valve_rated_pressure_drop";
  }

  void apply_modes() {
    if (const auto* change = proposal_.find("structure.mode_frequencies")) {
      note_before(change->key, "the case's");
      for (auto& mode : after_.structure->modes) mode.frequency = changed(*change, mode.frequency);
    }
    if (const auto* change = proposal_.find("structure.mode_damping_ratios")) {
      note_before(change->key, "the case's");
      for (auto& mode : after_.structure->modes) {
        mode.damping_ratio = changed(*change, mode.damping_ratio);
        check_changed_range(*change, Kind::number, Range::between(0.0, 1.0),
                            mode.damping_ratio.value);
      }
    }
    const auto* modes = proposal_.find("structure.mode_frequencies");
    const auto* locked = proposal_.find("structure.locked_rotor_frequency");
    for (const auto& mode : after_.structure->modes) {
      const double rotor = after_.structure->locked_rotor_frequency.value;
      if (mode.frequency.value > rotor) continue;
      const std::string message = fmt::format(
          "expected a locked-rotor frequency below every mode with the bull gear held (the gear "
          "spring can only lower a mode), found {:.4g} Hz and a mode of {:.4g} Hz",
          rotor, mode.frequency.value);
      if (locked != nullptr || modes != nullptr)
        refuse_change(locked != nullptr ? *locked : *modes, message);
    }
    try {
      structure_specifications(*after_.structure);
    } catch (const InvalidInput& error) {
      if (locked != nullptr || modes != nullptr) {
        refuse_change(locked != nullptr ? *locked : *modes, error.what());
      }
    }
  }

  // Last of the structure's changes: a factor on what those make of it.
  void apply_gear_spring() {
    const auto* change = proposal_.find("structure.gear_stiffness");
    if (change == nullptr) return;
    note_before(change->key, fmt::format("{:.5g} N.m/rad by the locked-rotor frequency",
                                         make_plant(before_).structure.gear_stiffness));
    stiffen_gear(*change, *after_.structure);
  }

  // Disks, count and inertia as built.
  void apply_motor() {
    MotorEntry& motor = *after_.motor;
    const MotorEntry& own = *before_.motor;
    if (const auto* change = proposal_.find("motor.count")) {
      const double count = changed(*change, static_cast<double>(own.count));
      if (count < 1.0 || std::abs(count - std::round(count)) > 1e-9) {
        refuse_change(*change, fmt::format("expected a whole number of motors, found {:g}", count));
      }
      motor.count = std::lround(count);
      note_before(change->key, fmt::format("{}", own.count));
    }
    const auto* disks = proposal_.find("motor.flywheel_disks");
    if (disks != nullptr) {
      motor.flywheel_disks = changed(*disks, own.flywheel_disks);
      note_before(disks->key, fmt::format("{:g}", own.flywheel_disks));
    }
    // As built the stated inertia holds; rotor and disks say what a change does to it.
    const double follows = own.inertia.value +
                           (motor.rotor_inertia.value - own.rotor_inertia.value) +
                           motor.flywheel_disks * motor.disk_inertia.value -
                           own.flywheel_disks * own.disk_inertia.value;
    const auto* inertia = proposal_.find("motor.inertia");
    const bool parts = disks != nullptr || proposal_.find("motor.disk_inertia") != nullptr ||
                       proposal_.find("motor.rotor_inertia") != nullptr;
    if (inertia != nullptr && parts && std::abs(motor.inertia.value - follows) > 0.01 * follows) {
      refuse_change(
          *inertia,
          fmt::format("expected the {:.5g} kg.m2 that {:g} disks make of the case's motor, within "
                      "1 %, found {:.5g} kg.m2: motor.flywheel_disks and its parts contradict it",
                      follows, motor.flywheel_disks, motor.inertia.value));
    }
    if (inertia == nullptr && parts) {
      if (!(follows > 0.0)) {
        refuse_change(
            disks != nullptr ? *disks : *first_of({"motor.disk_inertia", "motor.rotor_inertia"}),
            fmt::format("expected a motor with some inertia left, found {:.4g} kg.m2", follows));
      }
      motor.inertia.value = follows;
      motor.inertia.text = fmt::format("{:.6g} kg.m2", follows);
    }
  }

  const ProposedChange* first_of(std::initializer_list<std::string_view> keys) const {
    for (const auto key : keys) {
      if (const auto* change = proposal_.find(key)) return change;
    }
    return nullptr;
  }

  void check_friction() const {
    const auto& curve = *after_.friction_curve;
    const auto* change = first_of({"friction_curve.breakaway", "friction_curve.coulomb"});
    if (change != nullptr && curve.breakaway.value < curve.coulomb.value) {
      refuse_change(*change, fmt::format("expected friction_curve.breakaway of at least "
                                         "friction_curve.coulomb, found {:g} N.m and {:g} N.m",
                                         curve.breakaway.value, curve.coulomb.value));
    }
  }

  void note_before(const std::string& key, std::string text) {
    befores_.emplace_back(key, std::move(text));
  }

  void add_row(const ProposedChange& change) {
    const auto found = std::ranges::find(befores_, change.key, &Before::first);
    result_.changes.push_back({change.key, found != befores_.end() ? found->second : "-",
                               after_text(change), change.number.basis, change.number.source});
  }

  void check_any_change() {
    const bool any = std::ranges::any_of(proposal_.changes, [&](const auto& change) {
      if (change.multiplies) return change.number.value != 1.0;
      return change.key != "oil.line_share" && !same_as_before(change);
    });
    if (any || !proposal_.structures.empty()) return;
    refuse_at(proposal_.name_location, "name",
              fmt::format("expected a proposal that changes something, found {}",
                          proposal_.changes.empty()
                              ? "no change and no structures"
                              : "that every change leaves the case's number as it is"));
  }

  bool same_as_before(const ProposedChange& change) {
    for (const auto& number : changeable_numbers()) {
      if (change.key != number.path()) continue;
      const Quantity* own = number.in(original_);
      return own != nullptr && own->value == change.number.value;
    }
    const double value = change.number.value;
    if (change.key == "motor.count") return value == static_cast<double>(before_.motor->count);
    if (change.key == "motor.flywheel_disks") return value == before_.motor->flywheel_disks;
    if (change.key == "oil.bulk_modulus") return value == bulk_modulus(before_);
    if (change.key == "controller.sample_rate") {
      return control::dead_time_of(1.0 / value) == before_.controller->delay.value;
    }
    if (change.key.starts_with("gear_train.stage["))
      return gear_ratio(after_) == gear_ratio(before_);
    return false;
  }

  using Before = std::pair<std::string, std::string>;

  const Case& before_;
  const Proposal& proposal_;
  ProposedCase result_;
  Case& after_;
  Case original_ = before_;  // places of numbers are told of a case that may be written to
  std::vector<Before> befores_;
};

}  // namespace

ProposedCase apply_proposal(const Case& antenna, const Proposal& proposal) {
  return Application(antenna, proposal).run();
}

}  // namespace boresight::io
