// Rank 0 and its workers as threads of one process, with faults.
#include "cluster/render_manager.h"

#include <gtest/gtest.h>

#include <deque>
#include <mutex>
#include <thread>

#include "cluster/worker.h"

namespace etendue::cluster {
namespace {

// The messages between the ranks of a process.
class Mailboxes {
 public:
  explicit Mailboxes(int ranks) : boxes_(static_cast<size_t>(ranks)) {}

  void put(int to, Message message) {
    const std::scoped_lock lock(mutex_);
    boxes_[static_cast<size_t>(to)].push_back(std::move(message));
  }
  std::optional<Message> take(int rank) {
    const std::scoped_lock lock(mutex_);
    auto& box = boxes_[static_cast<size_t>(rank)];
    if (box.empty()) return std::nullopt;
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  int size() const { return static_cast<int>(boxes_.size()); }

 private:
  std::mutex mutex_;
  std::vector<std::deque<Message>> boxes_;
};

// What a rank does wrong.
enum class RankFault { none, damages_results, never_answers, damages_sums, sends_no_sums };

class ThreadRank final : public Communicator {
 public:
  ThreadRank(Mailboxes& boxes, int rank, RankFault fault = RankFault::none)
      : boxes_(boxes), rank_(rank), fault_(fault) {}

  int rank() const override { return rank_; }
  int size() const override { return boxes_.size(); }
  void send(int to, std::vector<std::byte> bytes) override {
    const bool is_result = kind_of(bytes) == MessageKind::result;
    if (is_result && fault_ == RankFault::never_answers) return;
    const bool is_sum = kind_of(bytes) == MessageKind::sum;
    if (is_sum && fault_ == RankFault::sends_no_sums) return;
    if ((is_result && fault_ == RankFault::damages_results) || (is_sum && fault_ == RankFault::damages_sums))
      bytes[bytes.size() / 2] ^= std::byte{1};
    boxes_.put(to, {rank_, std::move(bytes)});
  }
  std::optional<Message> receive() override { return boxes_.take(rank_); }
  void close() override {}
  [[noreturn]] void abort(int exit_code) override { std::_Exit(exit_code); }

 private:
  Mailboxes& boxes_;
  int rank_;
  RankFault fault_;
};

uint64_t some_hash(const render::Document&) { return 7; }

// A job whose workers are threads. They end with this object.
class Job {
 public:
  Job(int ranks, RankFault fault_of_last_rank = RankFault::none, WorkerSetup setup = {1, "1.0", some_hash})
      : boxes_(ranks), setup_(std::move(setup)), rank_0_(boxes_, 0) {
    for (int rank = 1; rank < ranks; ++rank)
      workers_.emplace_back([this, rank, fault = rank + 1 == ranks ? fault_of_last_rank : RankFault::none] {
        ThreadRank communicator(boxes_, rank, fault);
        run_worker(communicator, setup_);
      });
  }
  ~Job() {
    dismiss_ranks(rank_0_, 1, 60);
    for (std::thread& worker : workers_) worker.join();
  }
  Communicator& rank_0() { return rank_0_; }

 private:
  Mailboxes boxes_;
  WorkerSetup setup_;
  ThreadRank rank_0_;
  std::vector<std::thread> workers_;
};

ManagerSetup setup_of(const render::Document& document) {
  ScheduleOptions schedule;
  schedule.shortest_piece = 0;
  schedule.longest_piece = 0.05;
  schedule.shortest_patience = 0.2;
  schedule.first_patience = 0.2;
  return {.document = document, .identity = {"1.0", 7}, .threads = 1, .schedule = schedule};
}

Result<void> run(RenderManager& manager) {
  while (!manager.is_finished()) {
    if (auto ok = manager.step(); !ok) return ok;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {};
}

// A built-in scene, because workers open the document again from its state.
render::Document small_document(const std::string& integrator, uint32_t samples) {
  auto document = render::new_document("cornell");
  document->width = 40;
  document->height = 24;
  document->method.integrator = integrator;
  document->limits = {samples, 0, 0};
  return *document;
}

void expect_same_film(const film::Film& film, const film::Film& expected) {
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
        ASSERT_EQ(film.half_buffer_samples(x, y, half), expected.half_buffer_samples(x, y, half));
        ASSERT_EQ(film.sum(x, y, half), expected.sum(x, y, half)) << x << " " << y;
      }
}

void expect_image_of_one_process(RenderManager& manager, const render::Document& document) {
  const auto ok = run(manager);
  ASSERT_TRUE(ok) << ok.error().message;
  expect_same_film(manager.samples().film, render::rendered(document, document.limits.samples, 1));
  EXPECT_EQ(manager.status().samples, document.limits.samples);
}

TEST(RenderManager, AnyNumberOfRanksGivesTheSameBits) {
  for (const char* integrator : {"path", "bdpt", "light", "sppm", "photonmap", "igi", "vcm", "radiosity"})
    for (const int ranks : {1, 3}) {
      SCOPED_TRACE(integrator);
      const auto document = small_document(integrator, 20);
      Job job(ranks);
      RenderManager manager(job.rank_0(), setup_of(document));
      expect_image_of_one_process(manager, document);
    }
}

TEST(RenderManager, DamagedResultsAreRenderedAgain) {
  const auto document = small_document("path", 40);
  Job job(3, RankFault::damages_results);
  RenderManager manager(job.rank_0(), setup_of(document));
  expect_image_of_one_process(manager, document);
  EXPECT_NE(manager.summary().find("damaged results: "), std::string::npos) << manager.summary();
}

TEST(RenderManager, PiecesOfASilentRankAreRenderedByOthers) {
  const auto document = small_document("path", 40);
  Job job(3, RankFault::never_answers);
  RenderManager manager(job.rank_0(), setup_of(document));
  expect_image_of_one_process(manager, document);
  // On a busy machine, pieces of slow ranks are repeated as well.
  EXPECT_NE(manager.summary().find("repeated pieces: "), std::string::npos) << manager.summary();
  EXPECT_EQ(manager.summary().find("repeated pieces: 0"), std::string::npos) << manager.summary();
  EXPECT_NE(manager.summary().find("rank 2 does not answer"), std::string::npos) << manager.summary();
}

// A schedule in which ranks add results for rank 0.
ManagerSetup setup_with_collectors(const render::Document& document, int collectors) {
  ManagerSetup setup = setup_of(document);
  setup.schedule.collectors = collectors;
  return setup;
}

TEST(RenderManager, CollectorsKeepTheBits) {
  for (const char* integrator : {"path", "light"}) {
    SCOPED_TRACE(integrator);
    const auto document = small_document(integrator, 60);
    Job job(5);
    ManagerSetup setup = setup_with_collectors(document, 2);
    setup.schedule.shortest_patience = setup.schedule.first_patience = 60;
    RenderManager manager(job.rank_0(), std::move(setup));
    expect_image_of_one_process(manager, document);
    EXPECT_NE(manager.summary().find("ranks that added results: 2"), std::string::npos) << manager.summary();
    EXPECT_EQ(manager.summary().find("failed"), std::string::npos) << manager.summary();
  }
}

TEST(RenderManager, CollectorsNoticeDamagedResults) {
  const auto document = small_document("path", 60);
  Job job(4, RankFault::damages_results);
  RenderManager manager(job.rank_0(), setup_with_collectors(document, 1));
  expect_image_of_one_process(manager, document);
  EXPECT_NE(manager.summary().find("damaged results: "), std::string::npos) << manager.summary();
}

// The last rank is the only collector.
TEST(RenderManager, SamplesOfAFailedCollectorAreRenderedAgain) {
  for (const RankFault fault : {RankFault::damages_sums, RankFault::sends_no_sums}) {
    const auto document = small_document("path", 60);
    Job job(2, fault);
    RenderManager manager(job.rank_0(), setup_with_collectors(document, 1));
    expect_image_of_one_process(manager, document);
    EXPECT_NE(manager.summary().find("of which failed: 1"), std::string::npos) << manager.summary();
  }
}

TEST(RenderManager, ContinuesWithGaps) {
  const auto document = small_document("path", 20);
  ManagerSetup setup = setup_of(document);
  setup.samples = {film::Film(document.width, document.height), {}};
  for (const SampleRange range : {SampleRange{2, 5}, SampleRange{9, 10}}) {
    PieceRenderer renderer(document, 1);
    renderer.begin({1, range});
    std::optional<PieceResult> result;
    while (!result) result = renderer.take_result();
    setup.samples.tails.resize(result->samples.tails.size());
    add_samples(setup.samples, result->samples);
    setup.done.add(range);
  }
  Job job(2);
  RenderManager manager(job.rank_0(), std::move(setup));
  expect_image_of_one_process(manager, document);
}

TEST(RenderManager, StopsAtAnError) {
  auto document = small_document("path", 0);
  document.limits.error = 0.05;
  Job job(3);
  RenderManager manager(job.rank_0(), setup_of(document));
  const auto ok = run(manager);
  ASSERT_TRUE(ok) << ok.error().message;
  const uint32_t samples = manager.status().samples;
  EXPECT_EQ(manager.done().ranges(), (std::vector<SampleRange>{{0, samples}}));
  EXPECT_LE(manager.samples().film.error().rmse, 0.055);
  expect_same_film(manager.samples().film, render::rendered(document, samples, 1));
}

TEST(RenderManager, RefusesRanksOfAnotherVersion) {
  Job job(3, RankFault::none, {1, "0.9", some_hash});
  RenderManager manager(job.rank_0(), setup_of(small_document("path", 20)));
  const auto ok = run(manager);
  ASSERT_FALSE(ok);
  EXPECT_NE(ok.error().message.find("runs etendue 0.9, but rank 0 runs 1.0"), std::string::npos) << ok.error().message;
}

TEST(RenderManager, RefusesRanksWithAnotherScene) {
  Job job(2, RankFault::none, {1, "1.0", [](const render::Document&) { return uint64_t{8}; }});
  RenderManager manager(job.rank_0(), setup_of(small_document("path", 20)));
  const auto ok = run(manager);
  ASSERT_FALSE(ok);
  EXPECT_NE(ok.error().message.find("has another content"), std::string::npos) << ok.error().message;
}

TEST(PieceResult, DamagedBytesAreNoticed) {
  PieceRenderer renderer(small_document("path", 1), 1);
  renderer.begin({5, {3, 6}});
  std::optional<PieceResult> result;
  while (!result) result = renderer.take_result();
  const auto bytes = bytes_of(*result);
  const auto read = piece_result_from(bytes, 40, 24);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->piece.id, 5U);
  EXPECT_EQ(read->piece.samples, (SampleRange{3, 6}));
  expect_same_film(read->samples.film, result->samples.film);
  EXPECT_EQ(read->samples.tails, result->samples.tails);
  EXPECT_FALSE(piece_result_from(bytes, 24, 40));
  for (const size_t size : {size_t{0}, size_t{7}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_FALSE(piece_result_from(std::span(bytes).first(size), 40, 24)) << size;
  for (size_t i = 0; i < bytes.size(); i += 997) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{16};
    EXPECT_FALSE(piece_result_from(damaged, 40, 24)) << i;
  }
}

}  // namespace
}  // namespace etendue::cluster
