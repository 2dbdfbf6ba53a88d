#pragma once

#include <string>
#include <vector>

#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// Which tests to record first on the antenna of a case that has no records, and why, in
/// sentences: by what the case takes for granted and docs/identification.md says a test shows.
std::vector<std::string> first_tests(const io::Case& antenna);

}  // namespace boresight::app
