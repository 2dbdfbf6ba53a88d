#pragma once

#include <vector>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/page/page.hpp>
#include <boresight/io/code/code_writer.hpp>

namespace boresight::app {

/// The plan as sheets to fill in and sign on site: for each stage its command, the gains to set,
/// every check with its bracket and abort limit beside empty fields, the expected Bode plot, and
/// lines for result, name and date.
Page commission_sheets(const CommissionReport& report);

/// What is taken to the site, names within a folder: sheets.csv, a line a check with empty fields
/// for measured, passes, initials and date; and the controller of every stage as every command
/// reads it, stage_01_gains.toml or stage_01_state_space.json.
std::vector<io::CodeFile> commission_files(const CommissionReport& report);

}  // namespace boresight::app
