#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lag_loops.hpp"
#include <boresight/design/studies/retuned_present.hpp>

namespace boresight::design {
namespace {

TunedController tuned_row(const std::string& structure, TunedFor purpose,
                          double wind_speed = 10.0) {
  TunedController row;
  row.structure = structure;
  row.tuned_for = purpose;
  row.wind_speed = wind_speed;
  row.design.tuning.status = TuningStatus::optimal;
  row.design.tuning.controller.structure = control::LoopStructure::named(structure);
  return row;
}

TuningStudy study_of(std::vector<TunedController> rows) {
  TuningStudy study;
  study.controllers = std::move(rows);
  return study;
}

TEST(RetunedPresent, IsTheRobustDesignOfThePresentStructure) {
  const TuningStudy study =
      study_of({tuned_row("PI", TunedFor::robust), tuned_row("DPF", TunedFor::nominal),
                tuned_row("DPF", TunedFor::robust, 12.0), tuned_row("DPF", TunedFor::robust)});
  EXPECT_EQ(retuned_present(study, "DPF", 10.0), &study.controllers[3]);
  EXPECT_EQ(retuned_present(study, "LL", 10.0), nullptr);
}

TEST(RetunedPresent, IsTheStructureOfFewestGainsWithoutAPresentOne) {
  const TuningStudy study =
      study_of({tuned_row("FULL", TunedFor::robust), tuned_row("PI", TunedFor::present),
                tuned_row("PI", TunedFor::nominal), tuned_row("PI", TunedFor::robust)});
  EXPECT_EQ(retuned_present(study, "", 10.0), &study.controllers[3]);
}

// Which no antenna has today, and which has no gains at all.
TEST(RetunedPresent, IsNoStateSpace) {
  TuningStudy study = study_of({tuned_row("PI", TunedFor::robust)});
  study.controllers.push_back(tuned_row("FULL", TunedFor::robust));
  study.controllers[1].design.tuning.controller.structure =
      reference::lag_loops_as_state_space().structure;
  EXPECT_EQ(retuned_present(study, "", 10.0), &study.controllers[0]);
}

TEST(RetunedPresent, IsNoUnstableDesign) {
  TuningStudy study =
      study_of({tuned_row("PI", TunedFor::nominal), tuned_row("PI", TunedFor::robust)});
  study.controllers[1].design.tuning.status = TuningStatus::unstable;
  EXPECT_EQ(retuned_present(study, "PI", 10.0), &study.controllers[0]);
  study.controllers[0].design.tuning.status = TuningStatus::unstable;
  EXPECT_EQ(retuned_present(study, "PI", 10.0), nullptr);
}

}  // namespace
}  // namespace boresight::design
