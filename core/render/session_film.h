// The film of a session together with the statistics that are collected while it is sampled.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/document.h"
#include "render/film_recording.h"
#include "render/partial_result.h"
#include "render/thread_pool.h"

namespace etendue::render {

class SessionFilm {
 public:
  explicit SessionFilm(ThreadPool& workers) : workers_(workers) {}

  const film::Film& film() const { return film_; }
  film::Film& film() { return film_; }
  // The statistics of all samples, and their states.
  const TailStatistics& tails();
  std::vector<film::TailState> tail_states() const;
  FilmTargets targets() { return {.film = film_, .tails = &tails_, .reweighting = reweighting()}; }
  // Null unless the document re-weights fireflies.
  film::FireflyReweighting* reweighting() { return reweighting_ ? &*reweighting_ : nullptr; }

  // An empty film for a document. False if `keep_going` stopped it; it then has to be called again before sampling.
  bool clear(const Document& document, const std::function<bool()>& keep_going);

  // Continues with a film whose samples were taken elsewhere. Only their means are known, and the tail statistics if
  // they are given: others start empty, and firefly re-weighting treats all samples of a pixel as equally bright.
  void resume(const Document& document, film::Film&& film, std::span<const film::TailState> tails);

  // Adds samples of another process, of the same document. Returns false if `keep_going` stopped it; the next call, with
  // the same samples, then continues.
  bool add(const PartialSamples& samples, const std::function<bool()>& keep_going);
  // With samples of other processes, the numbers of samples do not follow from their counts in a pixel: all that are
  // recorded in between have this number.
  void begin_sample(uint32_t number);
  void finish_sample();

  // The image with fireflies re-weighted, three numbers per pixel; nothing unless the document re-weights fireflies.
  std::optional<std::vector<float>> reweighted() const;

  // Bytes that the film of a document takes, including its statistics.
  static size_t memory(const Document& document);

 private:
  void clear_tails(const Document& document);
  bool clear_cascades(const Document& document, const std::function<bool()>& keep_going);

  ThreadPool& workers_;
  film::Film film_;
  TailStatistics tails_;
  std::vector<film::TailState> shared_tails_;  // of samples of other processes; empty: there are none
  TailStatistics all_tails_;                   // if there are some
  int added_rows_ = 0;                         // of shared samples that are being added
  uint32_t sample_ = 0;                        // the number of the present sample, with samples of other processes
  film::InvalidSamples invalid_before_;        // this sample
  std::optional<film::FireflyReweighting> reweighting_;
};

}  // namespace etendue::render
