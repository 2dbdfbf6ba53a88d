#pragma once

#include <set>
#include <string>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/table_reader.hpp>

namespace boresight::io {

/// The key `name`, which must differ from those read before: ids and reports use it.
/// @throws InvalidInput as TableReader does
std::string read_name(TableReader& entry, std::set<std::string>& names);

/// One function a part of the case file: reads its tables into the case and refuses what does not
/// belong there. Each @throws InvalidInput as TableReader does.
void read_antenna(TableReader& file, Case& antenna);
void read_gear_train(TableReader& file, Case& antenna);
void read_motor(TableReader& file, Case& antenna);
void read_oil(TableReader& file, Case& antenna);
/// Resonance, tachometer, friction tests, impulse results: what the test campaign gave.
void read_tests(TableReader& file, Case& antenna);
void read_drive(TableReader& file, Case& antenna);
/// The friction curve as stated, or through tests at steady rates.
void read_friction_curve(TableReader& file, Case& antenna);
/// Nonlinear drive and recorder, for simulated tests.
void read_simulation(TableReader& file, Case& antenna);
void read_structure(TableReader& file, Case& antenna);
/// Records, their columns and instruments.
void read_campaign(TableReader& file, Case& antenna);
void read_sensors(TableReader& file, Case& antenna);
/// Signals of the antenna's control computer.
void read_computer(TableReader& file, Case& antenna);
void read_wind(TableReader& file, Case& antenna);
/// A mean wind speed as the case states it, at the height of the dish's centre.
Quantity at_dish_centre(const WindEntry& wind, const Quantity& stated);
void read_pointing(TableReader& file, Case& antenna);
void read_goals(TableReader& file, Case& antenna);
/// Wind speeds and attitudes with their fractions of the time, within [wind].
void read_climate(TableReader& wind, Case& antenna);
/// Custom structures, present gains, what to tune, and the plant ensemble.
void read_loops(TableReader& file, Case& antenna);
void read_ensemble(TableReader& file, Case& antenna);

}  // namespace boresight::io
