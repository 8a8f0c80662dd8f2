// Five hundred edits, faster than they can be rendered: integrators, their parameters, samplers, the camera, materials,
// path classes. There are no crashes, no leaks (address sanitizer) and no data races (thread sanitizer). Frames are
// never older than the previous frame. The final image is that of the last document.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "integrator/integrator.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using render::Document;

class Editor {
 public:
  explicit Editor(uint32_t seed) : random_(seed) {}

  Document edited(const Document& d) {
    static const std::vector<std::string> kSections{"render",  "render", "render", "method",     "method", "method",
                                                    "sampler", "film",   "camera", "material.0", "node.1", "model"};
    const std::string& kind = kSections[below(kSections.size())];
    const std::string section = kind == "method" ? d.method.integrator : kind == "sampler" ? d.method.sampler : kind;
    const auto list = render::section_parameters(d, section);
    if (list.empty()) return d;
    const render::DocumentParameter& b = list[below(list.size())];
    const auto changed = render::with(d, b.info.name, value_of(b.info));
    return changed && is_small(*changed) ? *changed : d;
  }

  size_t below(size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random_); }

 private:
  // Images stay small, and limits large.
  static bool is_small(const Document& d) {
    return d.width * d.height <= 64 * 64 && d.limits.samples == 0 && d.limits.seconds == 0 && d.limits.error == 0;
  }

  Value value_of(const ParameterInfo& info) {
    switch (info.type) {
      case ParameterType::toggle:
        return below(2) == 0;
      case ParameterType::choice:
        return info.options[below(info.options.size())];
      case ParameterType::integer:
        return static_cast<int64_t>(amount(info));
      case ParameterType::number:
        return amount(info);
    }
    return false;
  }

  // A value at the ends of the range, the default, or a value near it. The largest numbers of photons would take too
  // long.
  double amount(const ParameterInfo& info) {
    const double usual = std::holds_alternative<int64_t>(info.default_value)
                             ? static_cast<double>(std::get<int64_t>(info.default_value))
                             : std::get<double>(info.default_value);
    const double least = std::min(info.max, std::max(info.min, 0.1 * usual));
    const double most = std::max(info.min, std::min(info.max, 2 * usual + 1));
    switch (below(4)) {
      case 0:
        return info.min;
      case 1:
        return usual;
      default:
        return least + (most - least) * std::uniform_real_distribution<double>(0, 1)(random_);
    }
  }

  std::mt19937 random_;
};

TEST(Session, FiveHundredEditsOfEverything) {
  Editor editor(7);
  Document d = test::cornell(48);
  render::Session session({.threads = 3, .interactive = true, .publish_interval = 0.002});
  uint64_t newest = 0, shown = 0;
  std::vector<std::string> methods;
  for (const auto& info : integrator::integrator_infos()) methods.push_back(info.name);
  for (int i = 0; i < 500; ++i) {
    // Every integrator occurs, independent of chance.
    d = i % 10 == 0 ? *render::with(d, "render.integrator", methods[static_cast<size_t>(i / 10) % methods.size()])
                    : editor.edited(d);
    const uint64_t version = session.submit(d);
    ASSERT_GT(version, newest);
    newest = version;
    // Most edits cancel the previous one early; some wait until phases and passes are complete.
    const size_t longest = i % 5 == 0 ? 120 : 12;
    std::this_thread::sleep_for(std::chrono::microseconds(500 * editor.below(longest)));
    if (const auto frame = session.frame()) {
      ASSERT_GE(frame->version, shown);
      ASSERT_LE(frame->version, newest);
      shown = frame->version;
    }
  }
  // The image of a new session with the same document, bit for bit.
  Document last = test::cornell(24);
  last.limits = {2, 0, 0};
  session.submit(last);
  session.finish();
  const film::Film film = session.film_copy(), fresh = test::rendered(last, 2, 1);
  ASSERT_EQ(film.pixels().size(), fresh.pixels().size());
  for (size_t i = 0; i < fresh.pixels().size(); ++i) ASSERT_EQ(film.pixels()[i].sum, fresh.pixels()[i].sum) << i;
}

}  // namespace
}  // namespace etendue
