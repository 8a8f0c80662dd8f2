#include "integrator/bdpt.h"

#include "integrator/bidirectional.h"

namespace etendue::integrator {
namespace {

Techniques parsed(const std::string& text) { return *Techniques::parse(text); }

class Samples final : public Work {
 public:
  Samples(const Bdpt& method, const Pass& pass)
      : pass_(pass),
        plan_{method.heuristic,
              method.max_depth,
              method.roulette_start,
              parsed(method.without),
              parsed(method.only),
              method.weighted,
              method.reuse,
              pass.model->classes ? std::optional<transport::ClassJoin>(*pass.model->paths) : std::nullopt} {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) override {
    return transport::with_model(*pass_.model, [&]<class M>(M) { return sample_with<M>(block, radiance, turn); });
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) const {
    using Walks = Bidirectional<M>;
    static thread_local const auto walks = std::make_unique<Walks>();
    std::array<Rgb, size_t{Walks::kWidth} * Walks::kHeight> part;
    uint64_t rays = 0;
    for (int top = 0; top < block.height; top += Walks::kHeight)
      for (int left = 0; left < block.width; left += Walks::kWidth) {
        const PixelBlock piece{block.x + left, block.y + top, std::min(Walks::kWidth, block.width - left),
                               std::min(Walks::kHeight, block.height - top), block.sample};
        const auto traced = walks->sample(pass_, plan_, piece, part, turn);
        if (!traced) return {};
        rays += *traced;
        const Rgb* next = part.data();
        for (int y = top; y < top + piece.height; ++y)
          for (int x = left; x < left + piece.width; ++x) radiance[static_cast<size_t>(y * block.width + x)] = *next++;
      }
    return rays;
  }

  const Pass pass_;
  const BidirectionalPlan plan_;
};

}  // namespace

Result<void> accepts_techniques(std::string_view text) {
  const auto parsed = Techniques::parse(text);
  return parsed ? Result<void>() : parsed.error();
}

std::unique_ptr<Work> Bdpt::begin(const Pass& pass, const Work*) const {
  return std::make_unique<Samples>(*this, pass);
}

}  // namespace etendue::integrator
