// Films of a session: when a picture is taken, whatever the machine's speed.
#include "app/session/film.h"

#include <gmock/gmock.h>

#include "app/session/session_films.h"
#include "engine/io/atomic_file.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

/// Notes the times of its pictures.
class Times : public FilmMaker {
 public:
  explicit Times(Session& session) : session_(session) {}
  void begin(const FilmRequest& wanted) override { request = wanted, running_ = true; }
  bool running() const override { return running_; }
  void add() override { times.push_back(session_.snapshot()->time); }
  std::string end() override {
    running_ = false;
    return "film of " + std::to_string(times.size());
  }

  FilmRequest request;
  std::vector<double> times;

 private:
  Session& session_;
  bool running_ = false;
};

class Films : public ::testing::Test {
 protected:
  Films() : session_(waiting()), maker_(session_) {
    draw_plant(session_);
    session_.films().set_maker(&maker_);
  }
  Result run(const std::string& line) { return session_.run_text(line); }

  Session session_;
  Times maker_;
};

TEST_F(Films, PicturesAreAsFarApartAsAsked) {
  const double dt = session_.snapshot()->assets->scene.dt;
  must(run("record film.mp4 fps=25 size=320x200 ui=1 camera=front"));
  EXPECT_EQ(maker_.request.file, "film.mp4");
  EXPECT_EQ(maker_.request.size, (std::array<int, 2>{320, 200}));
  EXPECT_EQ(maker_.request.camera, "front");
  EXPECT_TRUE(maker_.request.with_interface);
  must(run("run 0.3"));
  must(run("step count=7"));
  must(run("run 0.2"));
  const long steps = session_.snapshot()->step;
  ASSERT_EQ(maker_.times.size(),
            1 + static_cast<std::size_t>(std::floor(static_cast<double>(steps) * dt * 25 + 1e-9)));
  for (std::size_t i = 0; i < maker_.times.size(); ++i) {
    EXPECT_GE(maker_.times[i], static_cast<double>(i) / 25 - 1e-9);
    EXPECT_LT(maker_.times[i], static_cast<double>(i) / 25 + dt) << "the first step after " << i;
  }
  EXPECT_EQ(run("stop recording").text, "film of " + std::to_string(maker_.times.size()));
  const std::size_t before = maker_.times.size();
  must(run("run 0.2"));
  EXPECT_EQ(maker_.times.size(), before) << "no film, no pictures";
}

TEST_F(Films, TheRunIsTheSameWithAndWithout) {
  must(run("run 0.25"));
  const std::uint64_t plain = session_.control().state_hash();
  const long steps = session_.snapshot()->step;
  must(run("reset"));
  must(run("record film.mp4 fps=30"));
  must(run("run 0.25"));
  EXPECT_EQ(session_.snapshot()->step, steps);
  EXPECT_EQ(session_.control().state_hash(), plain);
}

TEST_F(Films, FasterThanTheStepsPicturesAreRepeated) {
  const double dt = session_.snapshot()->assets->scene.dt;
  must(run("record film.mp4 fps=1000"));
  must(run("run 0.1"));
  EXPECT_NEAR(static_cast<double>(maker_.times.size()), 101, 1000 * dt + 1);
}

TEST_F(Films, FaultsAreTold) {
  EXPECT_THAT(run("record film.mp4 fps=0").text, HasSubstr("fps"));
  EXPECT_THAT(run("record film.mp4 size=wide").text, HasSubstr("WxH"));
  EXPECT_THAT(run("stop recording").text, HasSubstr("no film"));
  must(run("record film.mp4"));
  EXPECT_THAT(run("record other.mp4").text, HasSubstr("stop recording"));
  session_.films().set_maker(nullptr);
  EXPECT_THROW(run("record film.mp4"), NoPictures);
}

}  // namespace
}  // namespace pedicel::app
