// The viewer's session on rank 0 and its workers as threads of one process, with edits and faults.
#include "cluster/view_manager.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <thread>

#include "cluster/render_manager.h"
#include "cluster/view_worker.h"
#include "render/session.h"
#include "support/thread_ranks.h"

namespace etendue::test::viewing {
namespace {

using namespace cluster;  // NOLINT(google-build-using-namespace)

uint64_t hash_of_scene(const render::Document&) { return 7; }

bool is_film(const std::vector<std::byte>& bytes) { return view_kind_of(bytes) == ViewMessageKind::film; }

struct JobSetup {
  int ranks = 3;
  ThreadRank::Fault fault_of_last_rank = {};
  ViewWorkerSetup worker_of_last_rank = {1, "1.0", hash_of_scene};
  double longest_silence = 60;
};

// A session whose samples are shared with workers, which are threads. They end with this object.
class Job {
 public:
  explicit Job(const JobSetup& setup = {})
      : boxes_(setup.ranks),
        rank_0_(boxes_, 0),
        last_setup_(setup.worker_of_last_rank),
        manager_(std::make_unique<ViewManager>(rank_0_, ViewManagerSetup{.version = "1.0",
                                                                         .scene_hash = hash_of_scene,
                                                                         .longest_silence = setup.longest_silence,
                                                                         .shortest_piece = 0.01})),
        session_(std::make_unique<render::Session>(render::SessionOptions{
            .threads = 1, .interactive = true, .publish_interval = 0.01, .sharing = manager_.get()})) {
    for (int rank = 1; rank < setup.ranks; ++rank)
      workers_.emplace_back([this, rank, setup] {
        const bool is_last = rank + 1 == setup.ranks;
        ThreadRank communicator(boxes_, rank, is_last ? setup.fault_of_last_rank : ThreadRank::Fault());
        run_view_worker(communicator, is_last ? last_setup_ : setup_);
      });
  }
  ~Job() {
    session_.reset();
    manager_.reset();
    dismiss_ranks(rank_0_, 1, 60);
    for (std::thread& worker : workers_) worker.join();
  }

  render::Session& session() { return *session_; }
  ViewManager& manager() { return *manager_; }
  // Waits at most a minute.
  template <class Condition>
  bool wait_for(const Condition& condition) {
    const auto start = render::Clock::now();
    while (!condition(manager_->status())) {
      if (render::seconds_since(start) > 60) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  bool wait_for_others(uint32_t samples = 1) {
    return wait_for([&](const render::SharingStatus& status) { return status.other_samples >= samples; });
  }
  std::string messages() {
    for (const std::string& message : manager_->take_messages()) messages_ += message + "\n";
    return messages_;
  }

 private:
  Mailboxes boxes_;
  ThreadRank rank_0_;
  ViewWorkerSetup setup_{1, "1.0", hash_of_scene}, last_setup_;
  std::unique_ptr<ViewManager> manager_;
  std::unique_ptr<render::Session> session_;
  std::vector<std::thread> workers_;
  std::string messages_;
};

// A built-in scene, because workers open the document again from its state.
render::Document small_document(const std::string& integrator = "path") {
  auto document = render::new_document("cornell");
  document->width = 40;
  document->height = 24;
  document->method.integrator = integrator;
  return *document;
}

void expect_equal(const film::Film& film, const film::Film& expected) {
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
        ASSERT_EQ(film.half_buffer_samples(x, y, half), expected.half_buffer_samples(x, y, half));
        ASSERT_EQ(film.sum(x, y, half), expected.sum(x, y, half)) << x << " " << y;
      }
}

// Renders images with a limit and compares them with those of one process, until other ranks have had a share.
void expect_image_of_one_process(Job& job, render::Document document) {
  constexpr uint32_t kSamples = 60;
  document.limits.samples = kSamples;
  uint32_t shared = 0;
  for (document.seed = 1; document.seed < 50 && shared == 0; ++document.seed) {
    job.session().submit(document);
    job.session().finish();
    EXPECT_EQ(job.session().status().samples, kSamples);
    expect_equal(job.session().film_copy(), render::rendered(document, kSamples, 1));
    ASSERT_TRUE(job.wait_for([](const auto& status) { return status.own_samples + status.other_samples == kSamples; }));
    shared = job.manager().status().other_samples;
  }
  EXPECT_GT(shared, 0U);
}

TEST(ViewManager, SharedSamplesHaveTheBitsOfOneProcess) {
  for (const char* integrator : {"path", "bdpt", "light", "sppm", "photonmap", "igi", "vcm", "radiosity"}) {
    SCOPED_TRACE(integrator);
    Job job;
    const auto document = small_document(integrator);
    job.session().submit(document);
    ASSERT_TRUE(job.wait_for_others());
    expect_image_of_one_process(job, document);
    EXPECT_EQ(job.manager().status().active, 3);
  }
}

TEST(ViewManager, EditsAreRenderedByAllRanks) {
  Job job;
  auto document = small_document();
  job.session().submit(document);
  for (const double roughness : {0.2, 0.4, 0.3}) {
    document = *render::with(document, "material.0.roughness", roughness);
    document = *render::with(document, "material.1.metallic", roughness > 0.35 ? 1.0 : 0.0);
    job.session().submit(document);
    ASSERT_TRUE(job.wait_for_others());
  }
  document.width = 48;
  job.session().submit(document);
  ASSERT_TRUE(job.wait_for_others());
  expect_image_of_one_process(job, document);
}

// A uniform environment, seen by a camera that looks away from the box: all samples of a version are equal.
render::Document uniform_document(double radiance) {
  auto document = small_document();
  document.camera.to_world = document.camera.to_world * glm::rotate(Mat4(1), 3.14159265f, Vec3(0, 1, 0));
  document = *render::with(document, "environment.preset", std::string("uniform"));
  for (const char* channel : {"r", "g", "b"})
    document = *render::with(document, std::string("environment.tint.") + channel, radiance);
  return document;
}

// The versions of frames in which a pixel does not have the radiance of the version.
class FrameCheck {
 public:
  explicit FrameCheck(render::Session& session) : session_(session) {
    session.on_update([this] { check(); });
  }
  void expect(uint64_t version, double radiance) {
    const std::lock_guard lock(mutex_);
    expected_[version] = radiance;
  }
  size_t frames() const { return frames_; }
  size_t wrong() const { return wrong_; }

 private:
  void check() {
    const auto frame = session_.frame();
    const std::lock_guard lock(mutex_);
    const auto expected = expected_.find(frame->version);
    if (expected == expected_.end()) return;  // submitted just now
    ++frames_;
    for (const Rgb& pixel : *frame->pixels)
      if (std::abs(double{pixel.g} - expected->second) > 1e-4 * expected->second) {
        ++wrong_;
        return;
      }
  }

  render::Session& session_;
  std::mutex mutex_;
  std::map<uint64_t, double> expected_;
  std::atomic<size_t> frames_{0}, wrong_{0};
};

TEST(ViewManager, NoFrameMixesTwoVersions) {
  Job job({.ranks = 4});
  FrameCheck check(job.session());
  for (int edit = 0; edit < 60; ++edit) {
    const double radiance = 1 + edit % 7;
    check.expect(job.session().submit(uniform_document(radiance)), radiance);
    // Some edits follow at once; before others, films of all ranks have arrived or are on their way.
    if (edit % 3 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(edit));
    if (edit % 3 == 2) {
      ASSERT_TRUE(job.wait_for_others(1 + static_cast<uint32_t>(edit) % 5));
    }
  }
  ASSERT_TRUE(job.wait_for_others());
  EXPECT_GT(check.frames(), 20U);
  EXPECT_EQ(check.wrong(), 0U);
}

// The check finds samples of another document.
class WrongSamples final : public render::SharedSampling {
 public:
  bool begin(const render::Document& document) override {
    samples_.samples = {film::Film(document.width, document.height), {}};
    samples_.samples.tails.resize(render::TailStatistics::tile_count(document.width, document.height));
    for (int y = 0; y < document.height; ++y)
      for (int x = 0; x < document.width; ++x) samples_.samples.film.add(x, y, 0, Rgb(9));
    samples_.count = 1;
    return true;
  }
  void end() override {}
  void set_limit(uint32_t) override {}
  void hold(bool) override {}
  std::optional<uint32_t> next_sample() override { return ++next_; }
  bool has_samples() const override { return true; }
  std::optional<render::SharedSamples> take() override { return samples_; }
  render::SharingStatus status() const override { return {}; }
  std::vector<std::string> take_messages() override { return {}; }

 private:
  render::SharedSamples samples_;
  uint32_t next_ = 0;
};

TEST(ViewManager, TheCheckOfFramesFindsOtherVersions) {
  WrongSamples wrong;
  render::Session session({.threads = 1, .interactive = true, .publish_interval = 0.01, .sharing = &wrong});
  FrameCheck check(session);
  const auto document = uniform_document(2);
  check.expect(1, 2);
  ASSERT_EQ(session.submit(document), 1U);
  for (int i = 0; i < 6000 && check.wrong() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_GT(check.wrong(), 0U);
}

TEST(ViewManager, IntegratorsThatDoNotDivideRunOnRank0) {
  Job job;
  auto document = small_document("mlt");
  document.limits.samples = 4;
  job.session().submit(document);
  job.session().finish();
  ASSERT_TRUE(job.wait_for([](const render::SharingStatus& status) { return !status.note.empty(); }));
  const auto status = job.manager().status();
  EXPECT_EQ(status.active, 1);
  EXPECT_EQ(status.other_samples, 0U);
  EXPECT_NE(status.note.find("mlt does not divide into samples"), std::string::npos) << status.note;
  const film::Film film = job.session().film_copy(), expected = render::rendered(document, 4, 1);
  EXPECT_EQ(film.mean(20, 12), expected.mean(20, 12));
  // The next integrator is shared again.
  document = small_document();
  job.session().submit(document);
  EXPECT_TRUE(job.wait_for_others());
}

TEST(ViewManager, ASilentRankIsGivenUp) {
  std::atomic<bool> is_silent{false};
  Job job({.fault_of_last_rank = [&](std::vector<std::byte>&) { return !is_silent; }, .longest_silence = 3});
  const auto document = small_document();
  job.session().submit(document);
  ASSERT_TRUE(job.wait_for([](const render::SharingStatus& status) { return status.active == 3; }));
  is_silent = true;
  ASSERT_TRUE(job.wait_for([](const render::SharingStatus& status) { return status.active == 2; }));
  EXPECT_FALSE(job.manager().all_answer());
  EXPECT_NE(job.messages().find("rank 2: does not answer"), std::string::npos) << job.messages();
  expect_image_of_one_process(job, document);
  // It takes part again when it answers.
  is_silent = false;
  ASSERT_TRUE(job.wait_for([](const render::SharingStatus& status) { return status.active == 3; }));
  EXPECT_NE(job.messages().find("rank 2 answers again"), std::string::npos) << job.messages();
  expect_image_of_one_process(job, document);
}

TEST(ViewManager, DamagedFilmsAreNotAdded) {
  Job job({.fault_of_last_rank = [](std::vector<std::byte>& bytes) {
    if (is_film(bytes)) bytes[bytes.size() / 2] ^= std::byte{1};
    return true;
  }});
  const auto document = small_document();
  job.session().submit(document);
  ASSERT_TRUE(
      job.wait_for([](const render::SharingStatus& status) { return status.active == 2 && !status.note.empty(); }));
  EXPECT_NE(job.messages().find("rank 2: sends damaged films"), std::string::npos) << job.messages();
  expect_image_of_one_process(job, document);
}

TEST(ViewManager, RanksWithAnotherSceneOrVersionTakeNoPart) {
  const std::pair<ViewWorkerSetup, const char*> cases[] = {
      {{1, "1.0", [](const render::Document&) { return uint64_t{8}; }}, "cornell has another content there"},
      {{1, "0.9", hash_of_scene}, "runs etendue 0.9, but rank 0 runs 1.0"}};
  for (const auto& [worker, message] : cases) {
    Job job({.worker_of_last_rank = worker});
    const auto document = small_document();
    job.session().submit(document);
    ASSERT_TRUE(job.wait_for([](const render::SharingStatus& status) { return !status.note.empty(); }));
    EXPECT_NE(job.manager().status().note.find(message), std::string::npos) << job.manager().status().note;
    ASSERT_TRUE(job.wait_for_others());
    expect_image_of_one_process(job, document);
    EXPECT_EQ(job.manager().status().active, 2);
  }
}

TEST(ViewManager, OtherRanksPauseWithTheSession) {
  Job job;
  job.session().submit(small_document());
  ASSERT_TRUE(job.wait_for_others());
  job.session().pause(true);
  // Films that are on their way arrive; then nothing more does.
  uint32_t samples = 0;
  const auto is_quiet = [&](const render::SharingStatus& status) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return std::exchange(samples, status.other_samples) == status.other_samples;
  };
  EXPECT_TRUE(job.wait_for(is_quiet));
  job.session().pause(false);
  EXPECT_TRUE(job.wait_for_others(samples + 1));
}

TEST(ViewWorker, EndsWhenRank0IsSilent) {
  Mailboxes boxes(2);
  ThreadRank communicator(boxes, 1);
  EXPECT_FALSE(run_view_worker(communicator, {1, "1.0", hash_of_scene, 0.1}));
}

}  // namespace
}  // namespace etendue::test::viewing
