// What each technique of a bidirectional method adds to the view on the desk: a pyramid of small pictures.
//                                                                         thesis Fig. 9.25; Veach & Guibas 1995
//
// Row k holds the k + 2 ways to find a path of k edges: (s, t) takes s vertices from the light and t = k + 1 - s from
// the camera. Pictures are made one after the other beside the rendering, round by round with more samples. An edit of
// what they are of begins them anew.
#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/progressive_task.h"

namespace etendue::viewer {

class Notices;

struct TechniqueCell {
  int s = 0, t = 0;
  std::string absent;                                           // why it has no picture; empty if it has, or will have
  uint32_t samples = 0;                                         // of every pixel
  double mean = 0;                                              // luminance over the picture, W/(m^2 sr)
  double standard_error = 0;                                    // of it
  std::shared_ptr<const std::vector<float>> picture = nullptr;  // linear, three numbers a pixel

  int edges() const { return s + t - 1; }
};

struct TechniquePyramid {
  int width = 0, height = 0;         // of each picture
  TechniqueCell whole;               // all techniques together, with their weights
  std::vector<TechniqueCell> cells;  // row by row, from s = 0 on

  // Of all light that was found; nothing before both are known.
  std::optional<double> share(const TechniqueCell& cell) const;
};

struct TechniquesSetup {
  Toggle weighted{"techniques.weighted", "Weighted", true,
                  "On: what each adds to the picture. Off: what each finds by itself, paths of others included"};
  Number<int> longest{"techniques.longest", "Longest path", 4, {1, 8}, "Edges of the paths in the last row"};
  Number<int> samples{
      "techniques.samples", "Samples", 128, {2, 65536}, "Of every pixel of each small picture, at last", "spp",
      Scale::logarithmic};
  Number<float> exposure{
      "techniques.exposure", "Exposure", 0, {-10, 20}, "Of all small pictures, beside the picture's own", "EV"};
  auto knobs() { return std::tie(weighted, longest, samples, exposure); }
};

class TechniquesHand {
 public:
  TechniquesHand(const render::Session& session, const Editor& editor, const std::function<void()>& wake)
      : session_(session), editor_(editor), study_(wake), job_(wake) {}

  TechniquesSetup setup;

  // Whether the document's method has techniques to look at.
  bool possible() const;
  // Null until the first picture is there.
  const TechniquePyramid* shown() const { return study_.shown().get(); }
  // Whether what is shown is of the document, and whether all its pictures have their samples.
  bool fresh() const;
  bool whole() const { return fresh() && !running() && done_; }
  bool running() const { return study_.running(); }
  bool has_news() const { return study_.has_news(); }
  void forget() { study_.clear(), done_ = false; }
  // Called once a frame; somebody may be looking.
  void advance(bool looked_at, Notices& notices);

  // The set of techniques that the document's method leaves out; it must have techniques.
  std::string left_out() const;
  // Writes all pictures in the background: .exr as layers "technique.S.T", .png as a grid, as they are shown.
  void write(const std::string& file);
  bool writing() const { return job_.running(); }

 private:
  using Clock = std::chrono::steady_clock;
  bool asks_the_same() const;

  const render::Session& session_;
  const Editor& editor_;
  render::Document document_;  // that the pictures are of
  TechniquesSetup asked_;      // and what was set
  bool done_ = false;
  uint64_t version_ = 0;  // of the last edit
  Clock::time_point edited_;
  Study<TechniquePyramid> study_;
  Job<Result<std::string>> job_;
};

// The knobs of the setup, as scripts see them.
std::vector<ParameterInfo> techniques_parameters(const TechniquesSetup& setup = {});

// A set of techniques, as integrator/techniques.h reads them, with one put in, or taken out with all words that hold
// it.
std::string toggled(const std::string& set, int s, int t);

// "A point on a light is chosen ..."
std::string words_of(int s, int t);

}  // namespace etendue::viewer
