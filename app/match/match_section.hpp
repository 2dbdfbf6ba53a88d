#pragma once

#include <optional>
#include <string>

#include <boresight/design/studies/matching_study.hpp>
#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::app {

using design::FlatRange;
using design::FrictionThreshold;
using design::MatchPoint;
using design::MatchSeries;
using design::MatchTimeDomain;
using design::MatchTimeRuns;
using design::MatchValue;
using design::MatchVariant;
using design::MatchVariants;
using design::RuleVerdict;

/// Results of `boresight match`, and the parts of the case's text and page that its report needs.
struct MatchSection : design::MatchingStudy {
  std::optional<plant::WindMast> wind_mast;    // none: the case states speeds at the dish's centre
  std::optional<design::WhatIfTable> what_if;  // where a page asks for it
  bool friction_measured = false;              // the linear plant's friction slope
};

MatchSection section_of(const io::Case& antenna, design::MatchingStudy study);

/// "ratio 1", "as built" or both; empty for the other points.
std::string label_of(const MatchPoint& point);

/// "the case's plant", or what is not as the case has it.
std::string name_of(const MatchVariant& variant);

/// A rule in words, with its reason behind a comma or colon.
std::string text_of(design::ClassicRule rule);

}  // namespace boresight::app
