#pragma once

#include <string>

#include <boresight/design/decisions/assessment.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/exchange/reported_controller.hpp>

namespace boresight::io {

/// Gains from a file: TOML with the keys of [gains] (in that table or at the top), or a report in
/// JSON, of which controller_of_report. `structure` is empty for any. Every command reads gains by
/// this function, so that one file is one controller, to the last bit.
/// @throws InvalidInput naming the file: if it cannot be read, is of another structure, or as
/// controller_of_report.
GainsOfFile read_gains_file(const std::string& path, const Case& antenna,
                            const std::string& structure = {},
                            design::Fitness accepted = design::Fitness::unverified);

}  // namespace boresight::io
