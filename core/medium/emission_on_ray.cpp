#include "medium/emission_on_ray.h"

namespace etendue {
namespace {

// The integral of the density over a part of a ray inside one voxel, where it is a cubic polynomial: Gauss-Legendre
// quadrature with two points is exact.
float density_integral(const DensityGrid& grid, const GridRay& ray, float from, float to) {
  constexpr float kGaussPoint = 0.21132486540518712f;
  const float length = to - from;
  return 0.5f * length *
         (grid.density(ray.at(from + kGaussPoint * length)) + grid.density(ray.at(to - kGaussPoint * length)));
}

}  // namespace

template <class Color>
Color transmittance_and_emission_by_voxels(const HeterogeneousMedium& medium,
                                           const HeterogeneousCoefficients<Color>& coefficients, const RaySpan& span,
                                           RandomStream& random, Color& emitted) {
  const DensityGrid& grid = *medium.grid;
  const GridRay ray = medium.in_grid(span);
  const float metres = HeterogeneousMedium::metres(span);
  const GridSize voxels{grid.nodes()[0] - 1, grid.nodes()[1] - 1, grid.nodes()[2] - 1};
  Color transmittance(1);
  DensityGrid::traverse(ray, Vec3(voxels[0], voxels[1], voxels[2]), voxels, [&](float from, float to, size_t) {
    const float depth = density_integral(grid, ray, from, to) * metres;
    if (!(depth > 0)) return true;
    const float at = from + (to - from) * random.next();
    const Vec3 p = ray.at(at);
    const Color before = exponential_of(coefficients.extinction * (density_integral(grid, ray, from, at) * metres));
    emitted += transmittance * before * medium.emitted(coefficients, p, grid.density(p)) * ((to - from) * metres);
    transmittance *= exponential_of(coefficients.extinction * depth);
    return max_component(transmittance) > 0;
  });
  return transmittance;
}

template Rgb transmittance_and_emission_by_voxels(const HeterogeneousMedium&, const HeterogeneousCoefficients<Rgb>&,
                                                  const RaySpan&, RandomStream&, Rgb&);
template SampledSpectrum transmittance_and_emission_by_voxels(const HeterogeneousMedium&,
                                                              const HeterogeneousCoefficients<SampledSpectrum>&,
                                                              const RaySpan&, RandomStream&, SampledSpectrum&);

}  // namespace etendue
