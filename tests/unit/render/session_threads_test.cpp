// Concurrent use of sessions, for the thread sanitizer. Without it, the tests check that no thread blocks forever.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

// Edits of every kind: another light, another size, display settings only, another integrator.
void edit(render::Session& session, int rounds) {
  for (int i = 0; i < rounds; ++i) {
    auto d = test::cornell(i % 5 == 4 ? 40 : 64);
    d.seed = static_cast<uint64_t>(i / 2);
    d.display.exposure = static_cast<float>(i);
    if (i % 3 == 2) d.method.integrator = "path-pure";
    session.submit(d);
    if (i % 4 == 3) session.pause(i % 8 == 3);
    std::this_thread::sleep_for(std::chrono::milliseconds(i % 7));
  }
  session.pause(false);
}

// The state that an interface and a status line read continuously.
uint64_t read_state(const render::Session& session) {
  uint64_t seen = session.status().version + (session.scene() ? 1 : 0) + (session.model().summary().empty() ? 0 : 1);
  if (const auto frame = session.frame())
    for (const Rgb& pixel : *frame->pixels) seen += pixel.r >= 0 ? 1 : 0;
  return seen;
}

TEST(SessionThreads, ConcurrentEditsReadsAndCopies) {
  std::atomic<int> wakes{0};
  std::atomic<bool> over{false};
  std::atomic<uint64_t> seen{0};
  std::atomic<size_t> copied{0};
  {
    render::Session session({.threads = 3, .interactive = true, .publish_interval = 0.005});
    session.on_update([&] { ++wakes; });
    std::thread looker([&] {
      while (!over) seen += read_state(session);
    });
    std::thread copier([&] {
      while (!over) copied += session.film_copy().pixels().size();
    });
    // On a busy machine, the other threads may need more edits than one round has.
    do edit(session, 60);
    while (seen == 0 || copied == 0);
    over = true;
    looker.join();
    copier.join();
    auto last = test::cornell(32);
    last.limits.samples = 2;
    session.submit(last);
    session.finish();
    EXPECT_EQ(session.status().samples, 2U);
    EXPECT_FALSE(session.take_restart_latencies().empty());
    session.restart();  // and is destroyed while it renders
  }
  EXPECT_GT(wakes.load(), 0);
}

TEST(SessionThreads, FramesHaveTheVersionOfTheirDocument) {
  render::Session session({.threads = 2, .interactive = true, .publish_interval = 0.005});
  for (int i = 1; i <= 20; ++i) {
    const int size = 16 + i;
    const uint64_t version = session.submit(test::cornell(size));
    while (!session.frame() || session.frame()->version < version) std::this_thread::yield();
    EXPECT_EQ(session.frame()->width, size);
  }
}

TEST(SessionThreads, DisplayEditsShareThePixels) {
  render::Session session({.threads = 2, .interactive = true});
  auto d = test::cornell(32);
  d.limits.samples = 2;
  session.submit(d);
  session.finish();
  const auto wait_for = [&](uint64_t version, uint32_t samples) {
    while (!session.frame() || session.frame()->version < version || session.frame()->samples < samples)
      std::this_thread::yield();
    return session.frame();
  };
  const auto before = wait_for(1, 2);
  d.display.exposure = 1;
  const uint64_t version = session.submit(d);
  EXPECT_TRUE(wait_for(version, 2)->pixels == before->pixels);
  session.finish();
  EXPECT_TRUE(wait_for(version, 2)->pixels == before->pixels);
}

TEST(SessionThreads, TwoSessionsAreIndependent) {
  std::vector<std::thread> hands;
  for (int i = 0; i < 2; ++i)
    hands.emplace_back([i] {
      render::Session session({.threads = 2, .interactive = i == 0});
      auto d = test::cornell(32);
      d.limits.samples = 6;
      session.submit(d);
      session.finish();
      EXPECT_EQ(session.film_copy().samples(3, 3), 6U);
    });
  for (auto& hand : hands) hand.join();
}

}  // namespace
}  // namespace etendue
