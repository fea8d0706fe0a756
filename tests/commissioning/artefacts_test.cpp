#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/commissioning/job.h"
#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

using nlohmann::json;

TEST(Artefacts, KnowWhatTheyWereMadeFrom) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj", {"", "", "", "Ann", ""});
  ASSERT_OK(job);
  const auto recording = job->put(NewArtefact::of("recording", {{"series", 1}}));
  ASSERT_OK(recording);
  const auto clusters = job->put(NewArtefact::of("clusters", {{"k", 5}}, {recording->id}));
  ASSERT_OK(clusters);
  EXPECT_EQ(clusters->engineer, "Ann");
  EXPECT_EQ(clusters->made_by, "zerodrift " ZERODRIFT_VERSION);
  ASSERT_EQ(clusters->inputs.size(), 1u);
  EXPECT_EQ(clusters->inputs[0].kind, "recording");
  EXPECT_EQ(clusters->inputs[0].content_hash, recording->content_hash);
  const auto body = clusters->document();
  ASSERT_OK(body);
  EXPECT_EQ((*body)["k"], 5);
}

TEST(Artefacts, EqualResultsHaveEqualHashes) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  const auto a = job->put(NewArtefact::of("clusters", {{"k", 5}, {"seed", 1}}));
  const auto b = job->put(NewArtefact::of("clusters", {{"seed", 1}, {"k", 5}}));
  const auto c = job->put(NewArtefact::of("clusters", {{"k", 4}, {"seed", 1}}));
  const auto d = job->put(NewArtefact::of("clusters", {{"k", 5}, {"seed", 1}}, {}, {{"t.png", "x"}}));
  const auto e = job->put(NewArtefact::of("clusters", {{"k", 5}, {"seed", 1}}, {a->id}));
  ASSERT_OK(e);
  EXPECT_EQ(a->content_hash, b->content_hash);
  EXPECT_NE(a->content_hash, c->content_hash);
  EXPECT_NE(a->content_hash, d->content_hash);
  EXPECT_EQ(a->content_hash, e->content_hash);
  EXPECT_NE(a->input_hash, e->input_hash);
}

TEST(Artefacts, ReadingsOfTheMomentDoNotCount) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  const auto look = [&](double round_trip_ms, int serial) {
    auto machine = NewArtefact::of("machine", {{"serial", serial}, {"round_trip_ms", round_trip_ms}});
    machine.observed = {"round_trip_ms"};
    return job->put(machine)->content_hash;
  };
  const std::string first = look(1.2, 7);
  EXPECT_EQ(look(3.4, 7), first);
  EXPECT_NE(look(1.2, 8), first);
  EXPECT_TRUE(job->check()->ok());
  EXPECT_EQ((*job->latest("machine"))->body, R"({"round_trip_ms":1.2,"serial":8})");
}

TEST(Artefacts, RedoingAdds) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  for (int k = 3; k < 6; ++k) ASSERT_OK(job->put(NewArtefact::of("clusters", {{"k", k}})));
  const auto history = job->history("clusters");
  ASSERT_OK(history);
  ASSERT_EQ(history->size(), 3u);
  EXPECT_EQ(history->front().body, R"({"k":3})");
  const auto latest = job->latest("clusters");
  ASSERT_OK(latest);
  EXPECT_EQ((*latest)->id, history->back().id);
  EXPECT_FALSE(job->latest("model")->has_value());
  EXPECT_EQ(*job->kinds(), std::vector<std::string>{"clusters"});
}

TEST(Artefacts, CarryFiles) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  const std::string picture("\x89PNG\0\r\n\xff", 8);
  const auto made = job->put({"calibration", "{}", {}, {{"template.png", picture}, {"empty", ""}}, {}});
  ASSERT_OK(made);
  EXPECT_EQ(made->blob_names, (std::vector<std::string>{"empty", "template.png"}));
  EXPECT_EQ(*job->blob(made->id, "template.png"), picture);
  EXPECT_EQ(*job->blob(made->id, "empty"), "");
  EXPECT_EQ(code_of(job->blob(made->id, "other")), ErrorCode::bad_argument);
}

TEST(Artefacts, NeedInputsThatAreThere) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  EXPECT_EQ(code_of(job->put({"model", "{}", {17}, {}, {}})), ErrorCode::bad_argument);
  EXPECT_TRUE(job->history("model")->empty());
}

TEST(Artefacts, AreNotChangedBehindTheProgram) {
  const TemporaryFolder folder;
  const auto file = folder / "a.zdj";
  {
    auto job = Job::create(file);
    ASSERT_OK(job);
    ASSERT_OK(job->put({"model", R"({"a":1})", {}, {{"t.png", "picture"}}, {}}));
    EXPECT_TRUE(job->check()->ok());
  }
  run_sql(file,
          "DROP TRIGGER artefact_fixed; UPDATE artefact SET body = '{\"a\":2}';"
          "DROP TRIGGER blob_fixed; UPDATE blob SET bytes = x'00'");
  auto job = Job::open(file);
  ASSERT_OK(job);
  const auto report = job->check();
  ASSERT_OK(report);
  EXPECT_EQ(report->problems.size(), 2u);
  EXPECT_EQ(code_of(job->blob(1, "t.png")), ErrorCode::job_damaged);
}

}  // namespace
}  // namespace zerodrift::commissioning
