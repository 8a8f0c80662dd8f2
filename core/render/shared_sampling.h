// Sampling of an image by several processes (ranks), as the session of one of them sees it.
//
// The session renders previews and some of the samples; other ranks render others. No two take the same sample, so the
// image has the bits of one process with the same samples. Samples of the ranks belong to the document for which they
// were begun and are discarded with it: an image never contains samples of two documents.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/document.h"
#include "render/partial_result.h"

namespace etendue::render {

// What other ranks have rendered.
struct SharedSamples {
  PartialSamples samples;
  uint32_t count = 0;  // per pixel
  uint64_t rays = 0, paths = 0;
};

struct SharingStatus {
  int ranks = 1;   // with that of the session
  int active = 1;  // that render samples of the present document
  // Samples per pixel of the present document: of the session, and of other ranks. The latter have arrived.
  uint32_t own_samples = 0, other_samples = 0;
  std::string note;  // why ranks take no part; empty if all do
};

// Functions may be called from any thread.
class SharedSampling {
 public:
  // Begins the image of a document. Returns false if its samples cannot be divided; the session then renders alone.
  virtual bool begin(const Document& document) = 0;
  // Ends the image; the session renders alone.
  virtual void end() = 0;
  virtual void set_limit(uint32_t samples) = 0;  // per pixel; 0: none
  // Other ranks stop while the session does not render either.
  virtual void hold(bool stopped) = 0;
  // The number of the next sample that the session renders. Nothing if other ranks are rendering the last ones.
  virtual std::optional<uint32_t> next_sample() = 0;
  virtual bool has_samples() const = 0;
  // Everything that has arrived since the last call.
  virtual std::optional<SharedSamples> take() = 0;
  virtual SharingStatus status() const = 0;
  // Messages for the user since the last call, for example about a rank that does not answer.
  virtual std::vector<std::string> take_messages() = 0;

 protected:
  ~SharedSampling() = default;
};

}  // namespace etendue::render
