#include <set>
#include <string>

#include <gtest/gtest.h>

#include <boresight/control/controllers/usual_structures.hpp>

namespace boresight::control {
namespace {

TEST(UsualStructures, HaveEachANameOfTheirOwn) {
  std::set<std::string> full;
  for (const auto& name : usual_structures()) {
    const LoopStructure structure = LoopStructure::named(name);
    EXPECT_EQ(short_name(structure), name);
    full.insert(structure.name());
  }
  EXPECT_EQ(full.size(), 120U);
  EXPECT_EQ(usual_structures().size(), 120U);
}

TEST(ShortName, IsTheStructuresOwnWhereItIsNotUsual) {
  const LoopStructure own("own", LoopStructure::pi_with_lag().blocks());
  EXPECT_EQ(short_name(own), "own");
}

}  // namespace
}  // namespace boresight::control
