#include "support/resume.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "render/checkpoint.h"

namespace etendue::test {

void expect_same_bits(const film::Film& a, const film::Film& b, const std::string& what) {
  ASSERT_EQ(a.pixels().size(), b.pixels().size());
  for (size_t i = 0; i < a.pixels().size(); ++i) ASSERT_EQ(a.pixels()[i].sum, b.pixels()[i].sum) << what << ' ' << i;
}

void expect_same_bits_after_resume(render::Document d, const std::string& what, bool has_state) {
  const auto path = std::filesystem::temp_directory_path() / ("etendue-test-resume-" + d.method.integrator);
  render::Session one({.threads = 2});
  d.limits = {9, 0, 0};
  one.submit(d);
  one.finish();
  const film::Film whole = one.film_copy();
  const auto tails = one.tail_states();
  for (const bool running : {false, true}) {
    d.limits = {running ? 9u : 4u, 0, 0};
    render::Session first({.threads = 2});
    first.submit(d);
    if (running)
      while (first.status().samples < 2) std::this_thread::yield();
    else
      first.finish();
    render::ResumePoint copy = first.resume_point();
    ASSERT_TRUE(render::write_checkpoint(
        path, {render::state_json(d, 4), std::move(copy.film), 1, std::move(copy.integrator_state), copy.tails}));
    auto read = render::read_checkpoint(path);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->integrator_state.empty(), !has_state) << what;
    d.limits = {9, 0, 0};
    render::Session second({.threads = 2});
    second.submit(d, {std::move(read->film), std::move(read->integrator_state), std::move(read->tails)});
    second.finish();
    expect_same_bits(whole, second.film_copy(), what);
    EXPECT_EQ(second.tail_states(), tails) << what;
  }
  std::filesystem::remove(path);
}

}  // namespace etendue::test
