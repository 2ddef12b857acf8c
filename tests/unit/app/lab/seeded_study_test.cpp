#include "app/lab/seeded_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::lab {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;

int printed = 0;

/// A study of four seeds whose figure is a third of the seed.
class PartsOfAStudy : public ::testing::Test {
 protected:
  /// The text that a run with these arguments writes.
  std::string run(Shard shard, int views = 100, int first = 3) {
    const SeededStudy study = {{{"views", views}}, [](std::uint64_t seed) {
                                 return ordered_json{{"third", static_cast<double>(seed) / 3.0}};
                               }};
    const StudyPrinter printer{
        "thirds", [](const ordered_json& records) { printed = static_cast<int>(records.size()); }};
    EXPECT_TRUE(run_seeds(study, printer, {folder_ / "study.json", true, first, 4, shard}));
    return io::read_file(folder_ / "study.json").value();
  }
  static Error refusal(const std::vector<std::string>& texts) {
    const auto study = merged(texts, {"a.json", "b.json"});
    EXPECT_FALSE(study);
    return study ? Error{} : study.error();
  }

  TemporaryFolder folder_;
};

TEST_F(PartsOfAStudy, AreMergedToTheBytesOfOneRun) {
  const std::string one = run({1, 3}), two = run({2, 3}), three = run({3, 3});
  const auto all = merged({three, one, two}, {"3", "1", "2"});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->dump(1) + "\n", run({}));
  EXPECT_EQ(printed, 4);
}

TEST_F(PartsOfAStudy, HaveEverySeedOnce) {
  const ordered_json first = ordered_json::parse(run({1, 3}));
  ASSERT_EQ(first["records"].size(), 2U);
  EXPECT_EQ(first["records"][0]["seed"], 3);
  EXPECT_EQ(first["records"][1]["seed"], 6);
  // More parts than seeds: the last ones have nothing to do.
  EXPECT_TRUE(ordered_json::parse(run({5, 5}))["records"].empty());
}

TEST_F(PartsOfAStudy, AMissingOneIsNamedByItsSeeds) {
  EXPECT_THAT(refusal({run({1, 3}), run({2, 3})}).message, HasSubstr("has seed 5"));
}

TEST_F(PartsOfAStudy, OneThatIsGivenTwiceIsRefused) {
  EXPECT_THAT(refusal({run({1, 2}), run({1, 2})}).message,
              HasSubstr("a.json and b.json both have seed 3"));
}

TEST_F(PartsOfAStudy, OfAnotherStudyAreRefused) {
  EXPECT_THAT(refusal({run({1, 2}), run({2, 2}, 200)}).message,
              HasSubstr("b.json: has another \"options\" than a.json"));
  EXPECT_THAT(refusal({run({1, 2}), run({2, 2}, 100, 4)}).message, HasSubstr("\"first_seed\""));
}

TEST_F(PartsOfAStudy, ADamagedFileIsNamed) {
  const std::string good = run({1, 2});
  ordered_json without_records = ordered_json::parse(good);
  without_records.erase("records");
  ordered_json without_seed = ordered_json::parse(good);
  without_seed["records"][0].erase("seed");
  ordered_json of_another_seed = ordered_json::parse(good);
  of_another_seed["records"][0]["seed"] = 99;
  ordered_json of_no_seed = ordered_json::parse(good);
  of_no_seed["seed_count"] = 0;
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string("{}"), without_records.dump(),
        without_seed.dump(), of_another_seed.dump(), of_no_seed.dump()}) {
    const Error error = refusal({good, text});
    EXPECT_EQ(error.code, ErrorCode::kBadFormat);
    EXPECT_THAT(error.message, HasSubstr("b.json: "));
  }
}

}  // namespace
}  // namespace flytri::lab
