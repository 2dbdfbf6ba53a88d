#pragma once

#include <string>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// The tests to record first on the antenna of a case without records, with reasons, in sentences.
/// Chosen by the case's assumptions and the tests' uses in docs/identification.md.
std::vector<std::string> first_tests(const io::Case& antenna);

}  // namespace boresight::app
