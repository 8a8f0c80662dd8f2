#include "viewer/tasks/technique_task.h"

#include "camera/camera_ray.h"

#include <cctype>
#include <cmath>
#include <sstream>

#include "advisor/class_energy.h"
#include "film/film_image.h"
#include "image/image.h"
#include "integrator/bdpt/techniques.h"
#include "render/incompatibility.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/convergence_task.h"

namespace etendue::viewer {
namespace {

using integrator::Techniques;

constexpr int kWidth = 96, kTallest = 192;
// The picture has the processor to itself for so long after an edit.
constexpr double kRest = 0.3;
// Samples grow by this factor from round to round.
constexpr uint32_t kGrowth = 4;

const integrator::TechniqueParameters& knobs_of(const render::Document& d) {
  return integrator::find_integrator(d.method.integrator)->techniques;
}

std::string name_in(const render::Document& d, std::string_view knob) {
  return d.method.integrator + "." + std::string(knob);
}

render::Document changed(const render::Document& d, std::string_view knob, const Value& value) {
  const auto with = render::with(d, name_in(d, knob), value);
  return with ? *with : d;
}

int64_t longest_of(const render::Document& d) {
  const auto limit = render::get(d, name_in(d, "max-depth"));
  return limit ? std::get<int64_t>(*limit) : 0;
}

// Renders the small pictures of a document, round by round.
class Maker {
 public:
  Maker(const render::Document& document, const TechniquesSetup& setup,
        const std::shared_ptr<const scene::CompiledScene>& scene, const Study<TechniquePyramid>::Publisher& publish,
        const bench::Progress& watch)
      : small_(reduced(document)), setup_(setup), publish_(publish), watch_(watch), session_({1, false, 0.1, scene}) {
    pyramid_.width = small_.width, pyramid_.height = small_.height;
    for (int k = 1; k <= setup.longest; ++k)
      for (int s = 0; s <= k + 1; ++s) pyramid_.cells.push_back({s, k + 1 - s, absence(s, k + 1 - s)});
    films_.resize(pyramid_.cells.size() + 1);
  }

  void go() {
    const auto most = static_cast<uint32_t>(setup_.samples.value);
    for (uint32_t samples = std::min(2u, most);; samples = std::min(samples * kGrowth, most)) {
      if (!render(whole(), pyramid_.whole, films_.back(), samples)) return;
      for (size_t i = 0; i < pyramid_.cells.size(); ++i) {
        TechniqueCell& cell = pyramid_.cells[i];
        if (cell.absent.empty() && !render(alone(cell), cell, films_[i], samples)) return;
      }
      if (samples == most) return;
    }
  }

 private:
  static render::Document reduced(const render::Document& document) {
    render::Document d = document;
    d.width = kWidth;
    d.height = std::clamp(kWidth * document.height / std::max(1, document.width), 1, kTallest);
    return changed(d, knobs_of(d).only, std::string());
  }

  // Why a technique finds nothing here, as far as that is known beforehand.
  std::string absence(int s, int t) const {
    const std::string set = std::get<std::string>(*render::get(small_, name_in(small_, knobs_of(small_).without)));
    if (Techniques::parse(set)->contains(s, t)) return "Left out: the others do its work.";
    if (t == 0 && !CameraRays(small_.camera, small_.width, small_.height).can_be_hit())
      return "No light can fall onto this lens by chance.";
    const int64_t longest = longest_of(small_);
    return longest > 0 && s + t - 1 > longest ? "The paths are longer than the method's longest." : "";
  }

  render::Document whole() const { return changed(small_, knobs_of(small_).weighted, true); }

  render::Document alone(const TechniqueCell& cell) const {
    const auto& knobs = knobs_of(small_);
    auto d = changed(small_, knobs.only, std::to_string(cell.s) + "," + std::to_string(cell.t));
    d = changed(d, knobs.weighted, setup_.weighted.value);
    return changed(d, "max-depth", int64_t{cell.edges()});
  }

  // Goes on with a picture to so many samples; false if it was given up.
  bool render(render::Document d, TechniqueCell& cell, film::Film& film, uint32_t samples) {
    d.limits = {samples, 0, 0};
    const uint64_t version = cell.samples > 0 ? session_.submit(d, std::move(film)) : session_.submit(d);
    if (!bench::wait_for(session_, version, [&](const render::Status&) { return watch_(0, "techniques"); }))
      return false;
    film = session_.film_copy();
    const auto energy = advisor::energy_of(film);
    cell.samples = samples, cell.mean = energy.mean, cell.standard_error = energy.standard_error;
    cell.picture = std::make_shared<const std::vector<float>>(film::radiance_of(film));
    publish_(pyramid_);
    return watch_(0, "techniques");
  }

  const render::Document small_;
  const TechniquesSetup& setup_;
  const Study<TechniquePyramid>::Publisher& publish_;
  const bench::Progress& watch_;
  render::Session session_;
  TechniquePyramid pyramid_;
  std::vector<film::Film> films_;  // of the cells, and of the whole
};

// Side by side with gaps, row k below row k - 1; what has no picture is black.
Result<void> write_grid(const std::string& file, const TechniquePyramid& p, float exposure, image::ToneCurve curve) {
  constexpr size_t kGap = 4;
  const auto w = static_cast<size_t>(p.width), h = static_cast<size_t>(p.height);
  const auto rows = static_cast<size_t>(p.cells.back().edges()), columns = rows + 2;
  const size_t width = columns * (w + kGap) - kGap, height = rows * (h + kGap) - kGap;
  std::vector<uint8_t> grid(3 * width * height, 255);
  for (const TechniqueCell& cell : p.cells) {
    const auto shown =
        cell.picture ? image::display_pixels(*cell.picture, exposure, curve) : std::vector<uint8_t>(3 * w * h, 0);
    const size_t x = static_cast<size_t>(cell.s) * (w + kGap), y = static_cast<size_t>(cell.edges() - 1) * (h + kGap);
    for (size_t row = 0; row < h; ++row)
      std::copy_n(shown.begin() + static_cast<std::ptrdiff_t>(3 * w * row), 3 * w,
                  grid.begin() + static_cast<std::ptrdiff_t>(3 * ((y + row) * width + x)));
  }
  return image::write_png(file, static_cast<int>(width), static_cast<int>(height), grid);
}

Result<void> write_layers(const std::string& file, const TechniquePyramid& p) {
  image::LayeredImage picture{p.width, p.height, {}, {}};
  const auto add = [&](const std::string& name, const TechniqueCell& cell) {
    if (cell.picture) picture.layers.push_back({name, {"R", "G", "B"}, *cell.picture});
  };
  add("", p.whole);
  for (const auto& cell : p.cells) add("technique." + std::to_string(cell.s) + "." + std::to_string(cell.t), cell);
  return image::write_exr(file, picture);
}

}  // namespace

std::optional<double> TechniquePyramid::share(const TechniqueCell& cell) const {
  if (!cell.picture || !(whole.mean > 0)) return {};
  return cell.mean / whole.mean;
}

bool TechniquesHand::possible() const { return !editor_.empty() && !knobs_of(editor_.document()).empty(); }

bool TechniquesHand::asks_the_same() const {
  return same_view(editor_.document(), document_) && editor_.document().method == document_.method &&
         setup.weighted == asked_.weighted && setup.longest == asked_.longest && setup.samples == asked_.samples;
}

bool TechniquesHand::fresh() const { return shown() && asks_the_same(); }

void TechniquesHand::advance(bool looked_at, Notices& notices) {
  if (auto written = job_.take()) {
    if (*written)
      notices.say("Saved " + **written);
    else
      notices.complain(written->error().message);
  }
  if (editor_.version() != version_) version_ = editor_.version(), edited_ = Clock::now();
  if (study_.advance()) done_ = true;
  if (running() && !(looked_at && asks_the_same())) study_.call_off();
  const double rest = std::chrono::duration<double>(Clock::now() - edited_).count();
  if (!looked_at || !possible() || running() || rest < kRest || (done_ && asks_the_same())) return;
  document_ = editor_.document(), asked_ = setup, done_ = false;
  study_.start(
      [document = document_, asked = asked_, scene = session_.scene()](
          const auto& publish, const bench::Progress& watch) { Maker(document, asked, scene, publish, watch).go(); });
}

std::string TechniquesHand::left_out() const {
  const auto& d = editor_.document();
  return std::get<std::string>(*render::get(d, name_in(d, knobs_of(d).without)));
}

void TechniquesHand::write(const std::string& file) {
  if (!shown()) return;
  const auto& display = editor_.document().display;
  job_.start([file, pyramid = study_.shown(), exposure = display.exposure + setup.exposure,
              curve = display.curve]() -> Result<std::string> {
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension != ".exr" && extension != ".png")
      return usage_error(file + ": techniques are written as .exr or .png");
    const auto written =
        extension == ".exr" ? write_layers(file, *pyramid) : write_grid(file, *pyramid, exposure, curve);
    return written ? Result<std::string>(file) : written.error();
  });
}

std::vector<ParameterInfo> techniques_parameters(const TechniquesSetup& setup) {
  return describe_all(TechniquesSetup(setup).knobs());
}

std::string toggled(const std::string& set, int s, int t) {
  std::istringstream words(set);
  std::string kept;
  bool held = false;
  for (std::string word; words >> word;) {
    const auto parsed = Techniques::parse(word);
    if (parsed && parsed->contains(s, t))
      held = true;
    else
      kept += (kept.empty() ? "" : " ") + word;
  }
  if (!held) kept += (kept.empty() ? "" : " ") + std::to_string(s) + "," + std::to_string(t);
  return kept;
}

std::string words_of(int s, int t) {
  const std::string from_light = std::to_string(s) + (s == 1 ? " vertex" : " vertices");
  const std::string from_camera = std::to_string(t) + (t == 1 ? " vertex" : " vertices");
  if (s == 0) return "A walk from the camera meets a light.";
  if (t == 0) return "A walk from a light falls onto the lens.";
  if (s == 1 && t == 1) return "A point on a light is seen by the camera.";
  if (s == 1) return "A walk from the camera of " + from_camera + " is connected to a point chosen on a light.";
  if (t == 1)
    return "The end of a walk from a light of " + from_light + " is seen by the camera, anywhere in the picture.";
  return "A walk from the camera of " + from_camera + " and one from a light of " + from_light + " are connected.";
}

}  // namespace etendue::viewer
