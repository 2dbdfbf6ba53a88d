#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <boresight/identification/records/column_conflicts.hpp>
#include <boresight/identification/records/scale_conflicts.hpp>
#include <boresight/identification/records/test_recognition.hpp>
#include <boresight/io/campaign/loaded_record.hpp>
#include <boresight/io/campaign/raw_record.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/records/column_names.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::io {
namespace {

using identification::DefectHandling;
using identification::DefectKind;
using identification::TestKind;

constexpr std::pair<const char*, TestKind> tests[] = {{"slosh", TestKind::slosh},
                                                      {"fast-ramp", TestKind::fast_ramp},
                                                      {"slow-ramp", TestKind::slow_ramp},
                                                      {"constant-speed", TestKind::constant_speed},
                                                      {"valve-steps", TestKind::valve_steps},
                                                      {"valve-chirp", TestKind::valve_chirp},
                                                      {"other", TestKind::other}};

std::string resolved(const Case& antenna, const std::string& file) {
  const std::filesystem::path path(file);
  if (path.is_absolute()) return file;
  return (std::filesystem::path(antenna.path).parent_path() / path).string();
}

void load(const Case& antenna, const RecordEntry& entry, LoadedRecord& work) {
  RecordNotes& notes = work.notes;
  notes.name = entry.name;
  notes.description = entry.description;
  notes.path = resolved(antenna, entry.file);
  const RecordTable table = read_record(notes.path);
  notes.format = table.format;
  notes.bytes = table.bytes;
  notes.sha256 = table.sha256;
  notes.remarks = table.remarks;
  for (const auto& column : table.columns) work.columns.push_back({column.name, column.unit, {}});
  work.raw = raw_record(antenna, table, notes);
  work.raw.name = entry.name;
  for (const auto& [name, test] : tests) {
    if (entry.test == name) work.raw.test = test;
  }
  work.raw.test_known = !entry.test.empty();
  work.raw.rate_loop_closed = entry.rate_loop == "closed";
  work.clean = identification::clean_record(work.raw);
}

// A record may lack a column that the case names, but not every record: that is a misspelt name.
void check_names(const Case& antenna, const std::vector<LoadedRecord>& works) {
  RecordTable all;  // of all records' columns, one of each name
  std::set<std::string> seen;
  std::vector<std::string_view> names;
  for (const LoadedRecord& work : works) {
    for (const RecordColumn& column : work.columns) {
      all.columns.push_back(column);
      if (!seen.insert(column.name).second) all.columns.pop_back();
    }
  }
  for (const RecordColumn& column : all.columns) names.push_back(column.name);
  const auto check = [&](const std::string& name, const Location& location,
                         const std::string& key) {
    for (const LoadedRecord& work : works) {
      for (const RecordColumn& column : work.columns) {
        if (is_named(column, name)) return;
      }
    }
    refuse_at(location, key,
              fmt::format("expected a column of one record at least, found {}{} where they have {}",
                          in_quotes(name), did_you_mean(name, names), columns_of(all)));
  };
  const RecordColumnsEntry& entry = antenna.campaign->columns;
  for (const auto* command : {&entry.rate_command, &entry.valve_command, &entry.encoder}) {
    if (*command) check((*command)->name, (*command)->location, (*command)->key);
  }
  for (const std::string& name : entry.reversed)
    check(name, entry.reversed_location, "record_columns.reversed");
}

void refuse(LoadedRecord& work, DefectKind kind, const std::string& reason) {
  identification::CleanRecord& clean = work.clean;
  clean.record.reset();
  clean.refusal = reason;
  clean.defects.push_back(
      {kind, DefectHandling::refused, "", 0, 0.0, work.raw.time.size(), reason});
}

// A record whose tachometer is on another scale is not used, nor is a command.
void settle(LoadedRecord& work, const identification::ScaleConflict& conflict) {
  using Channel = identification::ScaleConflict::Channel;
  const identification::RawRecord& raw = work.raw;
  const bool is_tachometer = conflict.channel == Channel::tachometer;
  const bool is_rate = conflict.channel == Channel::rate_command;
  const std::string& channel = is_tachometer ? raw.tachometer.name
                               : is_rate     ? raw.rate_command->name
                                             : raw.valve_command->name;
  const std::string reason = fmt::format(
      "{} is {:.3g} times what it is in the other records for the same {}: check its "
      "scale and unit in this file",
      channel, conflict.factor, is_tachometer ? "command" : "motor rate");
  const auto handling = is_tachometer ? DefectHandling::refused : DefectHandling::left_out;
  work.clean.defects.push_back({DefectKind::wrong_scale, handling, channel, 0,
                                raw.time.size() > 0 ? raw.time[0] : 0.0, raw.time.size(), reason});
  if (is_tachometer) {
    work.clean.record.reset();
    work.clean.refusal = reason;
  } else {
    (is_rate ? work.clean.record->rate_command : work.clean.record->valve_command).reset();
  }
}

}  // namespace

std::string to_string(TestKind test) {
  const auto* const found = std::find_if(std::begin(tests), std::end(tests),
                                         [test](const auto& one) { return one.second == test; });
  return found->first;
}

std::vector<LoadedRecord> load_records(const Case& antenna, unsigned threads) {
  const auto& entries = antenna.campaign->records;
  std::vector<LoadedRecord> works(entries.size());
  numerics::for_each_index(works.size(), numerics::thread_count(threads),
                           [&](std::size_t i) { load(antenna, entries[i], works[i]); });
  check_names(antenna, works);
  return works;
}

void recognise(const Case& antenna, std::vector<LoadedRecord>& works) {
  std::vector<const identification::DriveRecord*> all;
  for (const LoadedRecord& work : works) {
    if (work.clean.record) all.push_back(&*work.clean.record);
  }
  const double fastest = identification::fastest_motion(all);
  for (std::size_t i = 0; i < works.size(); ++i) {
    identification::CleanRecord& clean = works[i].clean;
    if (!clean.record || !antenna.campaign->records[i].test.empty()) continue;
    works[i].notes.test_guessed = true;
    clean.record->test = identification::recognised_test(*clean.record, fastest);
    works[i].raw.test = clean.record->test;
    works[i].raw.test_known = true;
    if (clean.record->test == TestKind::slosh) {
      identification::mask_replaced(clean);
    } else if (clean.without_rate) {
      refuse(works[i], DefectKind::dead_channel,
             fmt::format("expected a tachometer that moves, found {} dead, and the record does not "
                         "look like a slosh test, which does without",
                         works[i].raw.tachometer.name));
    }
  }
}

void settle_conflicts(const Case& antenna, std::vector<LoadedRecord>& works) {
  std::vector<identification::EvaluatedRecord> evaluated;
  evaluated.reserve(works.size());
  for (const LoadedRecord& work : works) evaluated.push_back({&work.raw, &work.clean});
  const auto conflicts = identification::column_conflicts(evaluated);
  if (!conflicts.refusal.empty()) {
    throw InvalidInput(fmt::format("{}: record_columns: {}", antenna.path, conflicts.refusal));
  }
  for (std::size_t i = 0; i < works.size(); ++i) {
    const auto& conflict = conflicts.records[i];
    if (!conflict.refusal.empty()) {
      refuse(works[i], DefectKind::reversed_sign, conflict.refusal);
    } else if (conflict.again) {
      works[i].clean = identification::clean_record(works[i].raw, conflict.options);
    }
  }
  std::vector<const identification::DriveRecord*> records;
  records.reserve(works.size());
  for (const LoadedRecord& work : works) {
    records.push_back(work.clean.record ? &*work.clean.record : nullptr);
  }
  for (const auto& conflict : identification::scale_conflicts(records)) {
    settle(works[conflict.record], conflict);
  }
}

}  // namespace boresight::io
