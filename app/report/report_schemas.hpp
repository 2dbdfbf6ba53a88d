#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boresight::app {

/// The reports whose schema is made of their description, as docs/NAME.schema.json has them:
/// "benchmark" and so on.
const std::vector<std::string_view>& described_reports();

/// The JSON schema of one of them, as that file has it. @throws InvalidInput for another name.
std::string report_schema(std::string_view name);

}  // namespace boresight::app
