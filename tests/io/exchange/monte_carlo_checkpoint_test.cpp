#include <array>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "scratch_folder.hpp"
#include <boresight/io/exchange/monte_carlo_checkpoint.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using design::MonteCarloRun;
using design::PlantOutcome;
using testing::HasSubstr;

const std::string digest(64, 'd');

design::MonteCarlo study_of(std::uint64_t plants) {
  design::MonteCarlo study;
  study.problem = reference::tracking_problem();
  study.controller = reference::cautious_gains();
  study.plants = plants;
  study.plant = [](std::uint64_t) { return reference::antenna(); };
  return study;
}

// Blocks 0 and 2 of 250 plants, each outcome another.
MonteCarloRun half_done() {
  MonteCarloRun run(study_of(250));
  for (const std::size_t block : {std::size_t{0}, std::size_t{2}}) {
    std::vector<PlantOutcome> outcomes(block == 2 ? 50 : 100);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      outcomes[k].boresight_rms = 1e-6 * static_cast<double>(100 * block + k);
    }
    run.put(block, outcomes);
  }
  return run;
}

void expect_same(const MonteCarloRun& one, const MonteCarloRun& other, std::size_t block) {
  ASSERT_TRUE(one.whole(block) && other.whole(block));
  const auto a = one.outcomes(block), b = other.outcomes(block);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size_bytes()), 0);
}

TEST(MonteCarloCheckpoint, TakesUpWhatWasWholeToTheLastBit) {
  const ScratchFolder folder;
  const std::string path = folder.file("run.checkpoint");
  MonteCarloRun run = half_done(), taken(study_of(250));
  EXPECT_EQ(read_checkpoint(path, digest, taken), 0U);
  write_checkpoint(path, digest, run);
  EXPECT_EQ(read_checkpoint(path, digest, taken), 2U);
  EXPECT_FALSE(taken.whole(1));
  expect_same(run, taken, 0);
  expect_same(run, taken, 2);
}

TEST(MonteCarloCheckpoint, LeavesOutWhatIsDamaged) {
  const ScratchFolder folder;
  const std::string path = folder.file("run.checkpoint");
  const MonteCarloRun run = half_done();
  write_checkpoint(path, digest, run);
  const std::string whole = content_of(path);
  // The last block's digest lacks its end.
  folder.write("run.checkpoint", whole.substr(0, whole.size() - 3));
  MonteCarloRun cut(study_of(250));
  EXPECT_EQ(read_checkpoint(path, digest, cut), 1U);
  expect_same(run, cut, 0);
  std::string altered = whole;
  altered[altered.size() - 100] ^= 1;
  folder.write("run.checkpoint", altered);
  MonteCarloRun rest(study_of(250));
  EXPECT_EQ(read_checkpoint(path, digest, rest), 1U);
  EXPECT_FALSE(rest.whole(2));
}

TEST(MonteCarloCheckpoint, GoesFromOneProcessToAnother) {
  const MonteCarloRun run = half_done();
  MonteCarloRun other(study_of(250));
  EXPECT_EQ(put_blocks(to_bytes(run, {2}), other), 1U);
  EXPECT_FALSE(other.whole(0));
  expect_same(run, other, 2);
  EXPECT_EQ(put_blocks("", other), 0U);
}

TEST(MonteCarloCheckpoint, RefusesFilesOfOtherRuns) {
  const ScratchFolder folder;
  const std::string path = folder.file("run.checkpoint");
  write_checkpoint(path, digest, half_done());
  const auto refusal = [&](const std::string& asked, std::uint64_t plants) -> std::string {
    MonteCarloRun run(study_of(plants));
    try {
      read_checkpoint(path, asked, run);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal(digest, 250), "taken");
  EXPECT_THAT(refusal(std::string(64, 'e'), 250), HasSubstr("of another run"));
  EXPECT_THAT(refusal(digest, 240), HasSubstr("of another run"));
  folder.write("run.checkpoint", "title = \"an antenna\"\n");
  EXPECT_THAT(refusal(digest, 250), HasSubstr("expected a checkpoint"));
}

TEST(DigestOf, DiffersWhereTheRunDoes) {
  const auto random_samples = design::PlantDistribution::of_ranges({});
  const auto study = study_of(250);
  const std::string own = digest_of("1", "case", study, random_samples, 1);
  EXPECT_EQ(own.size(), 64U);
  EXPECT_EQ(own, digest_of("1", "case", study, random_samples, 1));
  EXPECT_NE(own, digest_of("2", "case", study, random_samples, 1));
  EXPECT_NE(own, digest_of("1", "another case", study, random_samples, 1));
  EXPECT_NE(own, digest_of("1", "case", study, random_samples, 2));
  auto other = study;
  other.controller.gains[0] *= 1.0 + 1e-15;
  EXPECT_NE(own, digest_of("1", "case", other, random_samples, 1));
  other = study;
  other.plant = [](std::uint64_t) { return reference::antenna(23.0); };
  EXPECT_NE(own, digest_of("1", "case", other, random_samples, 1));
}

}  // namespace
}  // namespace boresight::io
