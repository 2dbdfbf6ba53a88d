// Proposal files: what is read, and every refusal with its place.
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/proposals/proposal.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string head = "name = 'a'\ndescription = 'b'\n[cost]\namount = 1\ncurrency = 'kUSD'\n";

std::string refusal(const std::string& text) {
  try {
    parse_proposal(text, "p.toml");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ProposalFile, ReadsValuesAndFactors) {
  const Proposal proposal = parse_proposal(
      "name = 'new motors'\ndescription = 'larger'\nrisks = ['leak', 'slow']\n"
      "structures = ['PI', 'DPF']\n"
      "[cost]\namount = { value = '350', uncertainty = '30 %', basis = 'assumed', source = 's' }\n"
      "currency = 'kUSD'\n"
      "[motor]\ncount = 6\ndisplacement = { factor = '1.41', basis = 'assumed', source = 'frame' "
      "}\n"
      "[[gear_train.stage]]\nnumber = 3\ndriving_teeth = '17'\n"
      "[oil]\nline_lengths = { factor = 0.1 }\nline_share = '90 %'\n",
      "p.toml");
  EXPECT_EQ(proposal.name, "new motors");
  EXPECT_THAT(proposal.risks, ElementsAre("leak", "slow"));
  EXPECT_THAT(proposal.structures, ElementsAre("PI", "DPF"));
  ASSERT_TRUE(proposal.cost);
  EXPECT_DOUBLE_EQ(proposal.cost->amount.value, 350.0);
  EXPECT_DOUBLE_EQ(proposal.cost->amount.standard_uncertainty, 105.0);
  ASSERT_EQ(proposal.changes.size(), 5U);
  const auto* displacement = proposal.find("motor.displacement");
  ASSERT_NE(displacement, nullptr);
  EXPECT_TRUE(displacement->multiplies);
  EXPECT_DOUBLE_EQ(displacement->number.value, 1.41);
  EXPECT_EQ(displacement->number.basis, Basis::assumed);
  EXPECT_EQ(displacement->number.source, "frame");
  ASSERT_NE(proposal.find("gear_train.stage[3].driving_teeth"), nullptr);
  EXPECT_EQ(proposal.find("motor.inertia"), nullptr);
}

TEST(ProposalFile, ReadsALargerValve) {
  for (const std::string flow : {"'80 US_gal/min'", "{ factor = '2' }"}) {
    const Proposal proposal =
        parse_proposal(head + "[drive]\nvalve_rated_flow = " + flow, "p.toml");
    const auto* change = proposal.find("drive.valve_rated_flow");
    ASSERT_NE(change, nullptr);
    EXPECT_NEAR(change->number.value, change->multiplies ? 2.0 : 80.0 * 3.785411784e-3 / 60.0,
                1e-12);
  }
}

TEST(ProposalFile, MayLeaveOutItsCost) {
  const Proposal proposal =
      parse_proposal("name = 'a'\ndescription = 'b'\n[motor]\ncount = 6\n", "p.toml");
  EXPECT_FALSE(proposal.cost);
  EXPECT_NE(proposal.find("motor.count"), nullptr);
}

struct Refusal {
  const char* text;      // after the head
  const char* expected;  // part of the message
};

TEST(ProposalFile, RefusesWhatItCannotMean) {
  const std::array refusals{
      Refusal{"[motor]\ndisplacment = '1 cm3/rev'\n",
              "p.toml:7:1: motor.displacment: expected one of the keys"},
      Refusal{"[motor]\ndisplacment = '1 cm3/rev'\n", "(did you mean 'displacement'?)"},
      Refusal{"[motor]\ndisplacement = '1 kg'\n", "p.toml:7:19: motor.displacement: expected a "},
      Refusal{"[motor]\ndisplacement = { factor = '1.4', value = '1 cm3/rev' }\n",
              "motor.displacement.factor: expected either a value or a factor, found both"},
      Refusal{"[motor]\ndisplacement = { factor = '-1' }\n", "motor.displacement.factor: expected"},
      Refusal{"[motor]\ndisplacement = { factor = '2', scource = 'x' }\n",
              "(did you mean 'source'?)"},
      Refusal{"[motor]\nflywheel_disks = '-1'\n", "motor.flywheel_disks: expected"},
      Refusal{"[motor]\ncount = '2.5'\n", "motor.count: expected a whole number, found '2.5'"},
      Refusal{"[[gear_train.stage]]\nnumber = 1\n",
              "expected driven_teeth or driving_teeth beside it, found neither"},
      Refusal{"[[gear_train.stage]]\nnumber = 1\ndriven_teeth = 10\n"
              "[[gear_train.stage]]\nnumber = 1\ndriven_teeth = 11\n",
              "expected each stage once, found stage 1 again"},
      Refusal{"[[gear_train.stage]]\nnumber = 1\ndriven_teeth = 10.5\n",
              "driven_teeth: expected a whole number, found '10.5'"},
      Refusal{"[[gear_train.assembly]]\nname = 'J1'\n",
              "expected the assembly's inertia, found none"},
      Refusal{"[[gear_train.assembly]]\nname = 'J1'\ninertia = '1 kg.m2'\n"
              "[[gear_train.assembly]]\nname = 'J1'\ninertia = '1 kg.m2'\n",
              "expected each assembly once, found 'J1' again"},
      Refusal{
          "[oil]\nline_lengths = 2\n",
          "oil.line_lengths: expected { factor = \"...\" }, which multiplies the lengths of all "
          "lines, found a value"},
      Refusal{"[structure]\ngear_stiffness = '1e6 N.m/rad'\n",
              "p.toml:7:18: structure.gear_stiffness: expected { factor = \"...\" }, which "
              "multiplies the stiffness of the gear spring, found a value"},
      Refusal{"[structure]\ngear_stiffness = { value = '1e6 N.m/rad' }\n", "found a value"},
      Refusal{"[structure]\ngear_stiffness = { factor = '2', value = '1e6 N.m/rad' }\n",
              "gear_stiffness.factor: expected either a value or a factor, found both"},
      Refusal{"[structure]\nlocked_rotor_frequency = { factor = 2 }\n"
              "gear_stiffness = { factor = 2 }\n",
              "structure.gear_stiffness: expected either gear_stiffness, from which the "
              "locked-rotor frequency follows, or locked_rotor_frequency, found both"},
      Refusal{"[drive]\nvalve_rated_flow = '80 US_gal/min'\n"
              "[simulation]\nvalve_stroke = { factor = 2 }\n",
              "p.toml:7:20: drive.valve_rated_flow: expected either valve_rated_flow, from which "
              "the valve's stroke follows, or simulation.valve_stroke, found both"},
      Refusal{"[oil]\nline_share = '0.5'\n", "found no line_lengths"},
      Refusal{"[oil]\nline_lengths = { factor = 2 }\nline_share = { factor = '0.5' }\n",
              "expected a fraction within 0 to 1, found a factor"},
      Refusal{"[controller]\nsample_rate = { factor = 2 }\n",
              "expected a frequency such as \"100 Hz\", found a factor"},
      Refusal{"[hydraulics]\nx = 1\n", "hydraulics: expected one of the keys"}};
  for (const auto& one : refusals) {
    EXPECT_THAT(refusal(head + one.text), HasSubstr(one.expected)) << one.text;
  }
}

TEST(ProposalFile, RefusesABadHead) {
  EXPECT_EQ(refusal("name = 'a'\ndescription = 'b'\n[cost]\ncurrency = 'x'\n"),
            "p.toml:3:1: cost.amount: expected a number (such as 0.5, 5 %), found nothing: key is "
            "missing");
  EXPECT_THAT(refusal("nam = 'a'\n"), HasSubstr("name: expected a text, found nothing"));
  EXPECT_THAT(refusal("name = ' '\n"),
              HasSubstr("expected a name of 1 to 60 printable characters"));
  EXPECT_THAT(refusal("name = \"a\\u001b[2J\"\n"), HasSubstr("expected a name"));
  const std::string body = "description = 'b'\n[cost]\namount = 1\ncurrency = ''\n";
  EXPECT_THAT(refusal("name = 'a'\n" + body), HasSubstr("cost.currency: expected a currency"));
  EXPECT_THAT(refusal("name = 'a'\ndescription = 'b'\n[cost]\namount = '-1'\ncurrency = 'x'\n"),
              HasSubstr("cost.amount: expected"));
  EXPECT_THAT(refusal("name = 'a'\nstructures = []\n" + body),
              HasSubstr("structures: expected the name of a loop structure or more, found none"));
  EXPECT_THAT(refusal("name = 'a'\nstructures = ['PI', 'PI']\n" + body),
              HasSubstr("structures: expected each structure once, found 'PI' again"));
}

TEST(ProposalFile, NamesAFileThatIsNotThere) {
  EXPECT_THROW(read_proposal("no-such-folder/p.toml"), InvalidInput);
}

TEST(ProposalFile, ReadsEveryProposalOfTheCases) {
  int read = 0;
  const std::filesystem::path folder = BORESIGHT_SOURCE_DIR "/cases/dss14-70m/proposals";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Proposal proposal = read_proposal(entry.path().string());
    ASSERT_TRUE(proposal.cost) << entry.path();
    EXPECT_EQ(proposal.cost->currency, "kUSD") << entry.path();
    EXPECT_EQ(proposal.cost->amount.basis, Basis::assumed) << entry.path();
    EXPECT_FALSE(proposal.cost->amount.source.empty()) << entry.path();
    ++read;
  }
  EXPECT_GE(read, 7);
}

// Files made of pieces that come near the grammar: read, or refused in words with their place.
TEST(ProposalFile, SurvivesRandomFiles) {
  constexpr std::array<std::string_view, 37> pieces{"[motor]\n",
                                                    "[oil]\n",
                                                    "[drive]\n",
                                                    "[cost]\n",
                                                    "[structure]\n",
                                                    "[sensors]\n",
                                                    "[controller]\n",
                                                    "[[gear_train.stage]]\n",
                                                    "[[gear_train.assembly]]\n",
                                                    "[gear_train]\n",
                                                    "[gear_train.stage]\n",
                                                    "[antenna]\n",
                                                    "[friction_curve]\n",
                                                    "[simulation]\n",
                                                    "count = 3\n",
                                                    "flywheel_disks = '0'\n",
                                                    "displacement = { factor = 1.2 }\n",
                                                    "displacement = '1 cm3/rev'\n",
                                                    "displacement = { factor = '1', value = 2 }\n",
                                                    "number = 2\n",
                                                    "driven_teeth = '9'\n",
                                                    "name = 'J1'\n",
                                                    "inertia = { factor = nan }\n",
                                                    "inertia = '1 kg.m2'\n",
                                                    "line_lengths = { factor = '0.5' }\n",
                                                    "line_share = 1\n",
                                                    "gear_stiffness = { factor = '1.1' }\n",
                                                    "volume_1 = { factor = {} }\n",
                                                    "sample_rate = '100 Hz'\n",
                                                    "delay = { factor = 1e300 }\n",
                                                    "structures = ['PI', 3]\n",
                                                    "stage = [1, {}]\n",
                                                    "risks = 'x'\n",
                                                    "= ",
                                                    "{",
                                                    "\x80",
                                                    "mode_frequencies = { factor = '2 Hz' }\n"};
  std::mt19937_64 random(7);
  int accepted = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = random() % 4 == 0 ? "" : head;
    const std::size_t length = random() % 6;
    for (std::size_t i = 0; i < length; ++i) text += pieces[random() % pieces.size()];
    try {
      const Proposal proposal = parse_proposal(text, "p.toml");
      ++accepted;
      for (const auto& change : proposal.changes) {
        EXPECT_TRUE(std::isfinite(change.number.value)) << text;
      }
    } catch (const InvalidInput& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("expected ")) << text;
      EXPECT_THAT(error.what(), HasSubstr("p.toml:")) << text;
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace boresight::io
